// What differs between two resolved cases: a run is taken up only by the case that it began with.
#pragma once
#include <string>
#include <vector>

namespace breccia {

/// One line for each key that differs, "test.platen_speed = 0.1 m/s, was 0.05 m/s"; what may differ
/// is left out: run.checkpoint_every, [output], and where the specimen's file lies as long as it
/// holds the same.
std::vector<std::string> changed_keys(const std::string& before, const std::string& now);

/// False when the file of the specimen held something else then.
bool has_same_specimen(const std::string& before, const std::string& now);

}  // namespace breccia
