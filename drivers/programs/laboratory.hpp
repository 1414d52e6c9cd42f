// The programs of the laboratory tests: a specimen, one run per confinement, the results.
#pragma once
#include "core/loading/protocol.hpp"
#include "drivers/programs/command_line.hpp"
#include "io/cases/case.hpp"

namespace breccia {

/// What a case says of its run number `run`, and of the world that it needs.
/// @param test   name of the program
/// @param asked  features of the scene
LoadTest load_test(const Case& c, const std::string& test, std::size_t run);
WorldOptions world_options(const Case& c, const std::string& test, const Features& asked, int threads);

/// @throws BadInput, SimulationBroke, WriteError
void run_test_program(const CommandLine& line);

}  // namespace breccia
