#include "io/text/message_line.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace breccia {
namespace {

unsigned char byte(std::string_view text, std::size_t at) { return static_cast<unsigned char>(text[at]); }
bool continues(std::string_view text, std::size_t at) {
  return at < text.size() && (byte(text, at) & 0xc0) == 0x80;
}

/// Bytes of the character that begins here; 0 where none does (RFC 3629: no surrogates, shortest
/// form only).
std::size_t character(std::string_view text, std::size_t at) {
  const unsigned char first = byte(text, at);
  if (first < 0x80) return 1;
  const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4) return 0;
  for (std::size_t k = 1; k < bytes; ++k)
    if (!continues(text, at + k)) return 0;
  const unsigned char second = byte(text, at + 1);
  const bool wrong = (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) ||
                     (first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f);
  return wrong ? 0 : bytes;
}

/// The cut is moved down to where a character begins.
std::size_t between_characters(std::string_view text, std::size_t at) {
  std::size_t cut = std::min(at, text.size());
  for (int k = 0; k < 3 && cut > 0 && continues(text, cut); ++k) --cut;
  return cut;
}

std::string short_word(std::string_view word) {
  constexpr std::size_t longest = 300, head = 100, tail = 150;
  if (word.size() <= longest) return std::string(word);
  return fmt::format("{}...{}", word.substr(0, between_characters(word, head)),
                     word.substr(between_characters(word, word.size() - tail)));
}

}  // namespace

std::string shortened(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  std::size_t cut = between_characters(text, longest);
  const std::size_t blank = text.find_last_of(" \t", cut);
  if (blank != std::string_view::npos && blank >= longest / 2) cut = blank;
  return std::string(text.substr(0, cut)) + "...";
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = character(text, at);
    if (bytes == 0) return false;
    at += bytes;
  }
  return true;
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = character(text, at);
    if (bytes == 0)
      result += fmt::format("\\x{:02x}", byte(text, at++));
    else
      result += text.substr(at, bytes), at += bytes;
  }
  return result;
}

std::string message_line(std::string_view text) {
  std::string whole = printable(text), line;
  std::replace_if(
      whole.begin(), whole.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; },
      ' ');
  for (std::size_t at = 0; at < whole.size();) {
    const std::size_t end = std::min(whole.find(' ', at), whole.size());
    line += short_word(std::string_view(whole).substr(at, end - at));
    if (end < whole.size()) line += ' ';
    at = end + 1;
  }
  return line;
}

}  // namespace breccia
