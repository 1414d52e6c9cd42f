// What one key of a case says about another: bodies that a test does not take, keys that exclude or
// need each other, requests that cannot happen. Ranges and words of a single key are checked where
// it is read.
#pragma once
#include <string>
#include <vector>

#include "core/loading/laboratory_tests.hpp"
#include "io/cases/case.hpp"
#include "io/cases/case_defaults.hpp"

namespace breccia {

/// A case whose layers lie over each other, with the values that came of it.
struct CaseLaid {
  const Layer& layer;
  const Case& c;
  const LaboratoryTest* test;  ///< nullptr: breccia-pack
  std::string file;
  Standards defaults;
};

// All throw BadInput: one line with file, line, key and the cure.
void check_specimen(const CaseLaid& laid);
/// Ranges that the value of another key makes narrower.
void check_ranges(const CaseLaid& laid);
void check_test(const CaseLaid& laid);
/// @param groups  [[material.at]] of the case
/// @param used    confinements of the table that runs take their values from
void check_confinements(const CaseLaid& laid, const std::vector<ConfinementLayer>& groups,
                        const std::vector<double>& used);
/// @param law  of the material, as given
void check_law(const CaseLaid& laid, const Given& law);

/// Materials of groups: what their means need, and what takes no groups.
void check_groups(const CaseLaid& laid);

}  // namespace breccia
