// The programs of the laboratory tests: a specimen, one run per confinement, the results.
#pragma once
#include <string_view>

namespace breccia {

/// The program breccia-NAME, on any number of ranks.
/// @param name  of a row of core/loading/laboratory_tests.hpp
/// @returns the exit code
int run_laboratory_test(std::string_view name, int argc, char** argv);

}  // namespace breccia
