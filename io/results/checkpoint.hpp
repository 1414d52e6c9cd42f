// Checkpoints: all that a run needs to go on, in one file that any number of threads and ranks can
// take up. Several ranks write it together, each a part of every column.
//
//   DIR/checkpoint.h5          the newest; written aside and renamed, with a checksum behind it
//   DIR/checkpoint-before.h5   the one before, for the case that the newest is damaged
//
//   /                      format, version, case (the resolved TOML), run, finished (summaries of
//                          the runs before)
//     particles, bonds     columns: identity, history, state, ledger; in order of ids
//     contacts             the same, and reference
//     numbers              everything else, see core/loading/saved_state.hpp
#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/loading/load_test.hpp"

namespace breccia {

struct CheckpointHead {
  std::string case_text;  ///< resolved
  std::size_t run = 0;    ///< of the series
  std::string finished;   ///< JSON, the runs before it, see io/results/summary_json.hpp
};

struct FoundCheckpoint {
  std::filesystem::path file;
  CheckpointHead head;
};

/// Replaces the newest checkpoint, which becomes the one before. A kill at any moment, or a full
/// disk, leaves at least one that is whole. Called on every rank; what is not in the tables is the
/// root's.
/// @throws WriteError; the checkpoints that were there are then as they were, but for the name of
///         the newest where the disk fails at the very last
void write_checkpoint(const std::filesystem::path& folder, const CheckpointHead& head, World& world,
                      const LoadState& state, const LoadResult& result);

/// The newest checkpoint that is whole; nothing where there is none.
/// @param say  told, a line each, of those that are damaged
/// @throws BadInput when another version wrote it
std::optional<FoundCheckpoint> find_checkpoint(const std::filesystem::path& folder,
                                               const std::function<void(const std::string&)>& say);

/// Brings back a world that was made from the same case.
/// @throws BadInput when it has other particles or bonds
void read_checkpoint(const FoundCheckpoint& found, World& world, LoadState& state, LoadResult& result);

/// When a series is finished.
void remove_checkpoints(const std::filesystem::path& folder);

}  // namespace breccia
