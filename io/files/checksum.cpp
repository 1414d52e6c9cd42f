#include "io/files/checksum.hpp"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <vector>

#include "io/files/write_error.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> mark{'b', 'r', 'e', 'c', 's', 'e', 'a', 'l'};
constexpr std::size_t seal_bytes = mark.size() + sizeof(std::uint64_t);

/// Four chains of a multiplicative hash over words of eight bytes, so that a processor works on all
/// at once; each step is invertible, so that no single changed word goes unseen.
class Checksum {
public:
  /// @param bytes  a multiple of 32, but for the last piece
  void add(const char* data, std::size_t bytes) {
    for (std::size_t at = 0; at < bytes; at += 32) {
      std::array<std::uint64_t, 4> words{};
      std::memcpy(words.data(), data + at, std::min<std::size_t>(32, bytes - at));
      for (std::size_t k = 0; k < 4; ++k) {
        std::uint64_t& h = chains_[k];
        h = (h ^ words[k]) * 0x9e3779b97f4a7c15ull;
        h ^= h >> 29;
      }
    }
    length_ += bytes;
  }
  std::uint64_t value() const {
    std::uint64_t h = length_;
    for (const std::uint64_t chain : chains_) {
      h = (h ^ chain) * 0x9e3779b97f4a7c15ull;
      h ^= h >> 32;
    }
    return h;
  }

private:
  std::array<std::uint64_t, 4> chains_{1, 2, 3, 4};
  std::uint64_t length_ = 0;
};

/// Of the first `bytes` of a file; false when it has fewer.
bool sum_of(std::ifstream& in, std::size_t bytes, std::uint64_t& value) {
  Checksum sum;
  std::vector<char> piece(std::size_t{1} << 20);
  while (bytes > 0) {
    const std::size_t part = std::min(bytes, piece.size());
    if (!in.read(piece.data(), static_cast<std::streamsize>(part))) return false;
    sum.add(piece.data(), part);
    bytes -= part;
  }
  value = sum.value();
  return true;
}

}  // namespace

void append_checksum(const fs::path& file) {
  std::uint64_t value = 0;
  {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    std::ifstream in(file, std::ios::binary);
    if (error || !in || !sum_of(in, size, value)) fail_to_write(file, error ? error.value() : errno);
  }
  std::ofstream out(file, std::ios::binary | std::ios::app);
  out.write(mark.data(), mark.size());
  out.write(reinterpret_cast<const char*>(&value), sizeof(value));
  errno = 0;
  if (!out.flush()) fail_to_write(file, errno);
}

bool is_sealed(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size < seal_bytes) return false;
  std::ifstream in(file, std::ios::binary);
  std::uint64_t expected = 0, found = 0;
  if (!in || !sum_of(in, size - seal_bytes, expected)) return false;
  std::array<char, 8> there{};
  in.read(there.data(), there.size());
  in.read(reinterpret_cast<char*>(&found), sizeof(found));
  return in && there == mark && found == expected;
}

}  // namespace breccia
