// From a case to a bonded specimen: read or packed, put in place, checked, bonded.
#pragma once
#include "core/bonding/assembly.hpp"
#include "core/bonding/pieces.hpp"
#include "core/elastic/area_factor.hpp"
#include "core/loading/laboratory_tests.hpp"
#include "io/cases/case.hpp"
#include "io/results/progress.hpp"

namespace breccia {

/// The spheres of a case, axis along z and middle at the origin.
/// @param warnings  what does not forbid a test is added here
/// @throws BadInput: see check_specimen, check_sizes and check_body
Specimen make_specimen(const Case& c, int threads, Progress& progress, std::vector<std::string>& warnings);

/// What the scene of a case asks of the bond loop.
Features asked_features(const Case& c);

/// A specimen bonded and held as a test wants it, and the area factor of its bonds.
struct ReadySpecimen {
  Assembly assembly;
  AreaFactor factor;
  std::vector<AreaFactor> group_factors;  ///< as if the whole specimen were of one group's material
  Connection connection;
  std::vector<std::string> warnings;  ///< of each run of it
};

/// What a study of the specimen asks: the modulus and Poisson ratio that an elastic probe reads
/// with the factor in use, and how often the bonds' areas cover a section. One line; empty for a
/// specimen that is not held at its ends.
std::string describe_elasticity(const Case& c, const LaboratoryTest& test, const ReadySpecimen& ready,
                                int threads);

/// @param asked     features of the scene
ReadySpecimen make_ready(const Case& c, const LaboratoryTest& test, const Features& asked, int threads,
                         Progress& progress);

}  // namespace breccia
