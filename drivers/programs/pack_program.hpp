// The program breccia-pack: a packing from a case, as a file that every test reads.
#pragma once
#include "drivers/programs/command_line.hpp"

namespace breccia {

/// Writes OUT/specimen.csv and OUT/case.toml.
/// @throws BadInput, WriteError
void run_pack_program(const CommandLine& line);

}  // namespace breccia
