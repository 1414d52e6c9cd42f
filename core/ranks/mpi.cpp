#include "core/ranks/mpi.hpp"

#define OMPI_SKIP_MPICXX 1  // not the C++ functions of MPI 2, which nothing links
#include <mpi.h>

#include <algorithm>
#include <cstdlib>

namespace breccia {
namespace {

int number_of(const char* variable) {
  const char* text = std::getenv(variable);
  return text ? std::atoi(text) : 0;
}

/// Of the one exchange that has begun.
std::vector<MPI_Request> on_their_way;

/// As MPI takes it: bytes, or elements.
struct Layout {
  std::vector<int> count, first;
};

/// MPI counts with ints: what is larger goes in pieces of this many bytes.
constexpr std::size_t most_bytes = std::size_t{1} << 30;

Layout layout_of(std::span<const std::size_t> counts) {
  Layout layout;
  std::size_t first = 0;
  for (const std::size_t count : counts) {
    layout.count.push_back(static_cast<int>(count));
    layout.first.push_back(static_cast<int>(first));
    first += count;
  }
  return layout;
}

}  // namespace

Ranks ranks_of_launcher() {
  // Open MPI's own names: to ask MPI itself costs a third of a second, and a daemon
  const int count = number_of("OMPI_COMM_WORLD_SIZE");
  return count > 1 ? Ranks{number_of("OMPI_COMM_WORLD_RANK"), count} : Ranks{};
}

Ranks mpi_init() {
  Ranks ranks = ranks_of_launcher();
  if (ranks.alone()) return ranks;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &ranks.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks.count);
  return ranks;
}

void mpi_finalize() {
  int begun = 0;
  MPI_Initialized(&begun);
  if (begun) MPI_Finalize();
}

void mpi_abort(int code) {
  MPI_Abort(MPI_COMM_WORLD, code);
  std::abort();
}

void all_gather(const Ranks& ranks, const void* mine, std::span<const std::size_t> bytes, void* all) {
  const Layout layout = layout_of(bytes);
  MPI_Allgatherv(mine, layout.count[static_cast<std::size_t>(ranks.rank)], MPI_BYTE, all, layout.count.data(),
                 layout.first.data(), MPI_BYTE, MPI_COMM_WORLD);
}

void gather_at_root(const Ranks& ranks, const void* mine, std::span<const std::size_t> bytes, void* all) {
  constexpr int tag = 2;
  const auto pieces = [](std::size_t size, const auto& work) {
    for (std::size_t at = 0; at < size; at += most_bytes)
      work(at, static_cast<int>(std::min(most_bytes, size - at)));
  };
  if (!ranks.is_root()) {
    pieces(bytes[static_cast<std::size_t>(ranks.rank)], [&](std::size_t at, int count) {
      MPI_Send(static_cast<const char*>(mine) + at, count, MPI_BYTE, 0, tag, MPI_COMM_WORLD);
    });
    return;
  }
  char* to = static_cast<char*>(all);
  std::copy_n(static_cast<const char*>(mine), bytes[0], to);
  to += bytes[0];
  for (int from = 1; from < ranks.count; ++from) {
    const std::size_t size = bytes[static_cast<std::size_t>(from)];
    pieces(size, [&](std::size_t at, int count) {
      MPI_Recv(to + at, count, MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    });
    to += size;
  }
}

void broadcast(const Ranks& ranks, void* data, std::size_t bytes) {
  if (ranks.alone()) return;
  for (std::size_t at = 0; at < bytes; at += most_bytes)
    MPI_Bcast(static_cast<char*>(data) + at, static_cast<int>(std::min(most_bytes, bytes - at)), MPI_BYTE, 0,
              MPI_COMM_WORLD);
}

void all_reduce_max(const Ranks& ranks, std::span<double> values) {
  if (ranks.alone()) return;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX,
                MPI_COMM_WORLD);
}

bool any(const Ranks& ranks, bool here) {
  double value = here ? 1.0 : 0.0;
  all_reduce_max(ranks, {&value, 1});
  return value > 0.0;
}

std::vector<std::size_t> sizes_of_all(const Ranks& ranks, std::size_t mine) {
  std::vector<std::size_t> all(static_cast<std::size_t>(ranks.count), mine);
  if (ranks.alone()) return all;
  MPI_Allgather(&mine, 1, MPI_UINT64_T, all.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
  return all;
}

std::size_t all_reduce_sum(const Ranks& ranks, std::size_t mine) {
  const std::vector<std::size_t> all = sizes_of_all(ranks, mine);
  return std::accumulate(all.begin(), all.end(), std::size_t{0});
}

void barrier(const Ranks& ranks) {
  if (!ranks.alone()) MPI_Barrier(MPI_COMM_WORLD);
}

void all_to_all(std::size_t bytes, const void* mine, std::span<const std::size_t> to, void* all,
                std::span<const std::size_t> from) {
  const Layout there = layout_of(to), here = layout_of(from);
  MPI_Datatype element;
  MPI_Type_contiguous(static_cast<int>(bytes), MPI_BYTE, &element);
  MPI_Type_commit(&element);
  MPI_Alltoallv(mine, there.count.data(), there.first.data(), element, all, here.count.data(),
                here.first.data(), element, MPI_COMM_WORLD);
  MPI_Type_free(&element);
}

std::vector<std::size_t> sizes_for_me(std::span<const std::size_t> to) {
  std::vector<std::size_t> from(to.size());
  MPI_Alltoall(to.data(), 1, MPI_UINT64_T, from.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD);
  return from;
}

void exchange_send_lists(const Ranks& ranks, std::vector<Neighbour>& neighbours) {
  std::vector<int> wanted(static_cast<std::size_t>(ranks.count), 0), asked(wanted);
  for (const Neighbour& n : neighbours)
    wanted[static_cast<std::size_t>(n.rank)] = static_cast<int>(n.receive.size());
  MPI_Alltoall(wanted.data(), 1, MPI_INT, asked.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::vector<MPI_Request> requests(2 * neighbours.size(), MPI_REQUEST_NULL);
  constexpr int tag = 3;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    Neighbour& n = neighbours[k];
    n.send.resize(static_cast<std::size_t>(asked[static_cast<std::size_t>(n.rank)]));
    MPI_Irecv(n.send.data(), static_cast<int>(n.send.size()), MPI_UINT32_T, n.rank, tag, MPI_COMM_WORLD,
              &requests[2 * k]);
    MPI_Isend(n.receive.data(), static_cast<int>(n.receive.size()), MPI_UINT32_T, n.rank, tag, MPI_COMM_WORLD,
              &requests[2 * k + 1]);
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  std::erase_if(neighbours, [](const Neighbour& n) { return n.send.empty() && n.receive.empty(); });
}

void begin_exchange(std::vector<Neighbour>& neighbours) {
  on_their_way.assign(2 * neighbours.size(), MPI_REQUEST_NULL);
  constexpr int tag = 4;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    Neighbour& n = neighbours[k];
    MPI_Irecv(n.incoming.data(), static_cast<int>(n.incoming.size()), MPI_DOUBLE, n.rank, tag, MPI_COMM_WORLD,
              &on_their_way[2 * k]);
    MPI_Isend(n.outgoing.data(), static_cast<int>(n.outgoing.size()), MPI_DOUBLE, n.rank, tag, MPI_COMM_WORLD,
              &on_their_way[2 * k + 1]);
  }
}

bool finish_exchange() {
  if (on_their_way.empty()) return false;
  MPI_Waitall(static_cast<int>(on_their_way.size()), on_their_way.data(), MPI_STATUSES_IGNORE);
  on_their_way.clear();
  return true;
}

}  // namespace breccia
