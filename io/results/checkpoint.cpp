#include "io/results/checkpoint.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <system_error>

#include "core/base/error.hpp"
#include "core/base/hold.hpp"
#include "core/distributed/gather.hpp"
#include "core/loading/saved_state.hpp"
#include "core/stepping/resume.hpp"
#include "core/tables/row_order.hpp"
#include "io/files/atomic_write.hpp"
#include "io/files/checksum.hpp"
#include "io/files/disk_space.hpp"
#include "io/files/write_error.hpp"
#include "io/results/checkpoint_numbers.hpp"
#include "io/results/h5_columns.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t format = 3;  ///< of the file; another one is not read

const ColumnInfo listed_position{"Vec3",      "listed_position", "m",
                                 Role::state, Need::always,      "centre when contacts were last listed"};

fs::path newest(const fs::path& folder) { return folder / "checkpoint.h5"; }
fs::path before(const fs::path& folder) { return folder / "checkpoint-before.h5"; }

bool is_kept(Role role) {
  return role == Role::identity || role == Role::history || role == Role::state || role == Role::ledger;
}
bool is_kept_of_contacts(Role role) { return is_kept(role) || role == Role::reference; }
bool is_identity(Role role) { return role == Role::identity; }
bool changes(Role role) { return is_kept(role) && role != Role::identity; }
bool changes_of_contacts(Role role) { return is_kept_of_contacts(role) && role != Role::identity; }

/// The tables: every rank its part.
void write_world(hid_t file, const World& w) {
  {
    const h5::Handle group = h5::create_group(file, "particles");
    const FileOrder order = file_order(w.partition, w.particles);
    write_columns(group, w.particles, order, is_kept, true);
    if (!w.neighbour_list.position.empty())
      write_rows(group, listed_position, "state", order,
                 in_file_order<Vec3>(order, [&](Row row) { return w.neighbour_list.position[row]; }), true);
  }
  write_columns(h5::create_group(file, "bonds"), w.bonds, file_order(w.partition, w.bonds), is_kept, true);
  const FileOrder order = file_order(w.partition, w.contacts);
  const h5::Handle contacts = h5::create_group(file, "contacts");
  h5::write_attribute(contacts, "rows", std::uint64_t{order.total});
  write_columns(contacts, w.contacts, order, is_kept_of_contacts, true);
}

/// Everything else, by one rank.
void begin_file(const fs::path& path, const CheckpointHead& head, const World& w, const LoadState& state,
                const LoadResult& result) {
  h5::Handle file = h5::create_file(path.string(), 16);
  h5::write_attribute(file, "format", format);
  h5::write_attribute(file, "version", std::string_view(BRECCIA_VERSION));
  h5::write_attribute(file, "case", head.case_text);
  h5::write_attribute(file, "run", std::uint64_t{head.run});
  h5::write_attribute(file, "finished", head.finished);
  {
    const h5::Handle numbers = h5::create_group(file, "numbers");
    const NumberWriter write{numbers};
    for_each_number_of_world(w, write);
    for_each_number_of_test(state, result, write);
    std::string warnings;
    for (const std::string& line : result.warnings) warnings += line + '\n';
    h5::write_attribute(numbers, "warnings", warnings);
  }
  file.close("close");
}

/// @throws BadInput where a table of the file is that of another specimen
template <class Table>
void check_identity(hid_t group, const Table& table, std::span<const Row> order) {
  table.for_each_column([&](const ColumnInfo& info, const auto& column) {
    using T = ValueOf<decltype(column)>;
    if constexpr (!std::is_same_v<T, Row>) {
      if (!is_identity(info.role)) return;
      const std::string name(info.name);
      std::vector<T> rows;
      if (h5::rows_of_dataset(group, name, components_of<T>) == order.size())
        rows = read_rows<T>(group, name, order.size());
      bool same = rows.size() == order.size();
      for (std::size_t k = 0; same && k < order.size(); ++k) same = rows[k] == column[order[k]];
      if (!same) fail<BadInput>("it is of another specimen: the ids differ ({})", name);
    }
  });
}

void read_contacts(hid_t group, World& w) {
  const std::size_t count = h5::read_id_attribute(group, "rows");
  std::vector<Gid> lo, hi;
  if (count > 0) {
    lo = read_rows<Gid>(group, "gid_lo", count);
    hi = read_rows<Gid>(group, "gid_hi", count);
  }
  const std::vector<Row> rows = list_contacts(w, lo, hi);
  if (count > 0) read_columns(group, w.contacts, rows, changes_of_contacts);
}

void read_world(hid_t file, World& w) {
  const std::vector<Row> by_gid = rows_by_gid(w.particles), by_ends = rows_by_ends(w.bonds);
  const h5::Handle particles = h5::open_group(file, "particles"), bonds = h5::open_group(file, "bonds");
  check_identity(particles, w.particles, by_gid);
  check_identity(bonds, w.bonds, by_ends);
  read_columns(particles, w.particles, by_gid, changes);
  read_columns(bonds, w.bonds, by_ends, changes);
  if (!w.neighbour_list.position.empty()) {
    const auto positions = read_rows<Vec3>(particles, "listed_position", by_gid.size());
    for (std::size_t k = 0; k < by_gid.size(); ++k) w.neighbour_list.position[by_gid[k]] = positions[k];
  }
  read_contacts(h5::open_group(file, "contacts"), w);
}

/// The most that the numbers, and the tables, take in the file.
std::size_t bytes_of_numbers(const CheckpointHead& head, const World& w, const LoadState& state,
                             const LoadResult& result) {
  NumberCounter count;
  for_each_number_of_world(w, count);
  for_each_number_of_test(state, result, count);
  return count.bytes + head.case_text.size() + head.finished.size() + (std::size_t{1} << 20);
}
std::size_t bytes_of_tables(const World& w) {
  return column_bytes(w.particles) + column_bytes(w.bonds) + column_bytes(w.contacts) +
         sizeof(Vec3) * w.neighbour_list.position.size() + (std::size_t{1} << 20);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    lines.push_back(text.substr(at, end - at));
    at = end == std::string::npos ? text.size() : end + 1;
  }
  return lines;
}

/// What is wrong with a file, or its head.
std::optional<std::string> read_head(const fs::path& path, CheckpointHead& head) {
  if (!is_sealed(path)) return "its checksum is not that of what is in it";
  try {
    const h5::Handle file = h5::open_to_read(path.string());
    if (const std::uint64_t found = h5::read_id_attribute(file, "format"); found != format)
      fail<BadInput>(
          "{}: another version of breccia wrote it (format {}, this one reads {}): go on with that version, "
          "or run "
          "anew with --force",
          path.string(), found, format);
    head = {h5::read_text_attribute(file, "case"), h5::read_id_attribute(file, "run"),
            h5::read_text_attribute(file, "finished")};
  } catch (const h5::Failure& failure) {
    return failure.what();
  }
  return std::nullopt;
}

}  // namespace

void write_checkpoint(const fs::path& folder, const CheckpointHead& head, World& w, const LoadState& state,
                      const LoadResult& result) {
  h5::prepare();
  const Ranks& ranks = w.partition.ranks;
  const fs::path file = newest(folder), aside = name_aside(file);
  try {
    if (ranks.is_root()) {
      // on a full disk HDF5 may end the whole program when it closes a file: the room is claimed
      // first
      const World& whole = root_replica(w);
      if (!std::ofstream(aside, std::ios::trunc)) fail_to_write(aside, errno);
      preallocate(aside, bytes_of_numbers(head, whole, state, result));
      begin_file(aside, head, whole, state, result);
      hold_at(HoldPoint::checkpoint_begun);
      preallocate(aside, bytes_of_tables(whole));
    }
    barrier(ranks);
    {
      h5::Handle shared = h5::open_file(aside.string(), ranks);
      write_world(shared, w);
      shared.close("close");
    }
    barrier(ranks);
    if (!ranks.is_root()) return;
    hold_at(HoldPoint::checkpoint_filled);
    append_checksum(aside);
    flush_to_disk(aside);
    hold_at(HoldPoint::checkpoint_sealed);
  } catch (const std::exception& error) {
    std::error_code ignored;
    fs::remove(aside, ignored);
    if (dynamic_cast<const h5::Failure*>(&error) != nullptr) fail_to_write(file, error.what());
    throw;
  }
  std::error_code error;
  if (fs::exists(file, error)) fs::rename(file, before(folder), error);
  if (error) fail_to_write(before(folder), error.value());
  hold_at(HoldPoint::checkpoint_between);
  move_into_place(aside, file);
  hold_at(HoldPoint::checkpoint);
}

std::optional<FoundCheckpoint> find_checkpoint(const fs::path& folder,
                                               const std::function<void(const std::string&)>& say) {
  h5::prepare();
  for (const fs::path& file : {newest(folder), before(folder)}) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) continue;
    FoundCheckpoint found{file, {}};
    const auto trouble = read_head(file, found.head);
    if (!trouble) return found;
    say(fmt::format("{}: damaged, not used: {}", file.string(), *trouble));
  }
  return std::nullopt;
}

void read_checkpoint(const FoundCheckpoint& found, World& w, LoadState& state, LoadResult& result) {
  try {
    const h5::Handle file = h5::open_to_read(found.file.string());
    read_world(file, w);
    const h5::Handle numbers = h5::open_group(file, "numbers");
    const NumberReader read{numbers};
    for_each_number_of_world(w, read);
    for_each_number_of_test(state, result, read);
    result.warnings = lines_of(h5::read_text_attribute(numbers, "warnings"));
  } catch (const h5::Failure& failure) {
    fail<BadInput>("{}: cannot be taken up: {}; remove it to go on from the one before", found.file.string(),
                   failure.what());
  } catch (const BadInput& bad) {
    fail<BadInput>("{}: {}; run without --resume", found.file.string(), bad.what());
  }
  restore(w);
}

void remove_checkpoints(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::path& file : {newest(folder), before(folder), name_aside(newest(folder))})
    fs::remove(file, ignored);
}

}  // namespace breccia
