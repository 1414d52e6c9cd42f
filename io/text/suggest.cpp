#include "io/text/suggest.hpp"

#include <algorithm>
#include <cctype>

#include "io/text/message_line.hpp"

namespace breccia {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Distance of the words as they are counts once, without regard to case twice: "Mpa" is nearer to
/// "MPa" than to "bar".
std::size_t nearness(std::string_view word, std::string_view candidate) {
  return edit_distance(word, candidate) + 2 * edit_distance(lower(word), lower(candidate));
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before = above;
    above = row;
  }
  return above[b.size()];
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 200;  // nobody means a key by more than that, and to compare it takes long
  if (word.size() > longest) return "";
  std::string best;
  std::size_t least = 3 * std::max<std::size_t>(1, word.size() / 3) + 1;  // a third of the letters may differ
  for (const std::string& candidate : candidates) {
    const std::size_t distance = nearness(word, candidate);
    if (distance < least) least = distance, best = candidate;
  }
  if (!best.empty()) return best;
  for (const std::string& candidate : candidates) {  // "inch" for "in", "spec" for "specimen"
    const bool longer = candidate.size() >= 2 && lower(word).starts_with(lower(candidate));
    const bool shorter = word.size() >= 3 && lower(candidate).starts_with(lower(word));
    if (longer || shorter) return candidate;
  }
  return "";
}

std::string quote(std::string_view text) {
  constexpr std::size_t longest = 80;
  std::string result = shortened(text, longest);
  std::replace_if(
      result.begin(), result.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return '"' + result + '"';
}

std::string quote_list(const std::vector<std::string>& words) {
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : ", ") + quote(word);
  return result;
}

std::string suggest(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string best = nearest(word, candidates);
  return best.empty() ? "valid: " + quote_list(candidates) : "did you mean " + quote(best) + "?";
}

}  // namespace breccia
