// From a case and a recipe to a run, and many of them side by side.
#pragma once
#include <functional>
#include <map>
#include <optional>

#include "core/loading/load_test.hpp"
#include "core/studies/workprecision/trial.hpp"
#include "drivers/programs/prepare_specimen.hpp"

namespace breccia {

/// Runs end when the deviator has fallen by this fraction of its peak: nothing later is read.
inline constexpr double study_drop = 0.2;

/// The case as every run of the study takes it: its first confinement, no cycles, no frames.
struct StudyScene {
  Case c;
  std::string test;  ///< "ucs" or "triaxial"
  Features asked;
  std::map<Precision, ReadySpecimen> ready;  ///< of the case's specimen; a loop may need columns of its own
};

/// "triaxial" where the case or a --set names test.confinement, else "ucs".
std::string test_of_case(const std::filesystem::path& file, const std::vector<std::string>& sets);

/// @throws BadInput
StudyScene make_study_scene(const Case& c, const std::string& test, const std::vector<Trial>& trials,
                            int threads, Progress& progress);

/// Whether the bond loop of the case is built in single precision.
bool has_single_loop(const Case& c);

/// The recipe that the case names.
Recipe recipe_of(const Case& c);

/// A packing of its own in the body of the case.
ReadySpecimen pack_for_trial(const StudyScene& scene, const Trial& trial);

/// @param ready  of the case, or of the trial's packing
/// @returns nothing when interrupted
std::optional<Outcome> run_trial(
    const StudyScene& scene, const ReadySpecimen& ready, const Trial& trial,
    const std::function<bool()>& stop,
    const std::function<void(const World&, int, double, const CurveRow&)>& progress = {});

/// Calls work(0) ... work(tasks - 1) on threads of their own, `lanes` at a time; no more begin once
/// one has thrown or `stop` is true. Throws what the first of them threw.
void run_side_by_side(std::size_t tasks, int lanes, const std::function<bool()>& stop,
                      const std::function<void(std::size_t)>& work);

}  // namespace breccia
