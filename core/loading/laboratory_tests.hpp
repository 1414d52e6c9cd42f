// The laboratory tests, a row each: which specimens a test takes, what it holds and presses,
// whether it goes in cycles, and what its curve can tell. A new test is one row here, a protocol
// (core/loading) where its loading is none of those that there are, a driver of one line, a case
// and a picture.
#pragma once
#include <array>
#include <string_view>

#include "core/base/scene_options.hpp"
#include "core/loading/plan.hpp"

namespace breccia {

/// What test.confinement is to a test.
enum class PressureRole {
  none,          ///< the test has none
  must_be_zero,  ///< it is unconfined, and says so
  lateral,       ///< on the lateral surface, zero if not given
  needed         ///< the test is nothing without: the end of a hydrostatic test, the lid of a shear box
};

/// The straight line through the strengths of a series.
enum class StrengthLine { none, mohr_coulomb, shear };

struct LaboratoryTest {
  std::string_view name;   ///< of its program: breccia-NAME
  std::string_view about;  ///< for --help
  Loading loading = Loading::compression;
  Support support = Support::ends;
  bool cylinder = true, box = false, disc = false;  ///< bodies that it takes in three dimensions
  bool three_d = true, two_d = false;
  std::string_view other_space{};  ///< the test that is this one in the other dimension
  PressureRole pressure = PressureRole::none;
  bool rigid_sides = false;    ///< the lateral surface cannot move sideways
  bool always_rough = false;   ///< whatever test.platens says
  bool smooth = false;         ///< test.platens is "smooth" if not given
  bool in_cycles = false;      ///< unloads and loads again where asked
  bool across = false;         ///< presses a disc along a diameter
  bool strain_ends_it = true;  ///< false: a pressure does
  bool uniform_strain = true;  ///< moduli mean something
  bool tensile = false;        ///< its strength is a tensile one
  StrengthLine line = StrengthLine::none;
};

inline constexpr std::array<LaboratoryTest, 9> laboratory_tests{{
    {.name = "ucs",
     .about = "Unconfined compression of a cylinder between two platens.",
     .box = true,
     .two_d = true,
     .pressure = PressureRole::must_be_zero,
     .in_cycles = true},
    {.name = "triaxial",
     .about =
         "Triaxial compression of a cylinder or box: one run per confinement, and the envelope of the peaks.",
     .box = true,
     .other_space = "biaxial",
     .pressure = PressureRole::lateral,
     .in_cycles = true,
     .line = StrengthLine::mohr_coulomb},
    {.name = "bts",
     .about = "Brazilian test: a disc pressed along a diameter between two strips.",
     .support = Support::strips,
     .cylinder = false,
     .disc = true,
     .two_d = true,
     .smooth = true,
     .across = true,
     .uniform_strain = false,
     .tensile = true},
    {.name = "usc",
     .about = "Uniaxial strain compression: a cylinder whose lateral surface cannot move sideways.",
     .rigid_sides = true,
     .uniform_strain = false},
    {.name = "hydrostatic",
     .about = "Hydrostatic compression of a cylinder or box up to a pressure.",
     .loading = Loading::hydrostatic,
     .box = true,
     .pressure = PressureRole::needed,
     .smooth = true,
     .strain_ends_it = false,
     .uniform_strain = false},
    {.name = "tension",
     .about = "Direct tension of a cylinder or box with glued ends.",
     .loading = Loading::tension,
     .box = true,
     .two_d = true,
     .in_cycles = true,
     .tensile = true},
    {.name = "shear",
     .about = "Direct shear of a cylinder or box at half its height, one run per normal stress.",
     .loading = Loading::shear,
     .support = Support::halves,
     .box = true,
     .pressure = PressureRole::needed,
     .always_rough = true,
     .uniform_strain = false,
     .line = StrengthLine::shear},
    {.name = "cut",
     .about = "Cutting: a rigid tool scrapes the top of a block that is held in a vice.",
     .loading = Loading::cutting,
     .support = Support::vice,
     .cylinder = false,
     .box = true,
     .always_rough = true,
     .uniform_strain = false},
    {.name = "biaxial",
     .about = "Biaxial compression of a rectangle of discs: one run per confinement.",
     .cylinder = false,
     .box = true,
     .three_d = false,
     .two_d = true,
     .other_space = "triaxial",
     .pressure = PressureRole::lateral,
     .smooth = true,
     .in_cycles = true,
     .line = StrengthLine::mohr_coulomb},
}};

/// The row of a program's name; nullptr where the program is no laboratory test.
constexpr const LaboratoryTest* find_laboratory_test(std::string_view name) {
  for (const LaboratoryTest& test : laboratory_tests)
    if (test.name == name) return &test;
  return nullptr;
}

}  // namespace breccia
