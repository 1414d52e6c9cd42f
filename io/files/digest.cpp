#include "io/files/digest.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <memory>
#include <new>
#include <vector>

#include "core/base/error.hpp"
#include "io/text/input_file.hpp"

namespace breccia {

std::string sha256_of(const std::filesystem::path& file) {
  const InputFile in = open_input(file);
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> sum(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  if (!sum || EVP_DigestInit_ex(sum.get(), EVP_sha256(), nullptr) != 1) throw std::bad_alloc();
  std::vector<char> piece(std::size_t{1} << 20);
  for (std::size_t got; (got = std::fread(piece.data(), 1, piece.size(), in.get())) > 0;)
    EVP_DigestUpdate(sum.get(), piece.data(), got);
  if (std::ferror(in.get())) fail<BadInput>("{}: cannot be read to its end", file.string());
  std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
  unsigned count = 0;
  EVP_DigestFinal_ex(sum.get(), bytes.data(), &count);
  std::string hex;
  for (unsigned k = 0; k < count; ++k) hex += fmt::format("{:02x}", bytes[k]);
  return hex;
}

}  // namespace breccia
