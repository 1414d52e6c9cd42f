// "Did you mean": the valid word that is nearest to what somebody wrote.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace breccia {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn one word into the
/// other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `word`, differences of case counting little; empty when none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// The cure for a wrong word: `did you mean "x"?` when one is near, else `valid: "x", "y"`.
std::string suggest(std::string_view word, const std::vector<std::string>& candidates);

/// Words in double quotes with commas between them.
std::string quote_list(const std::vector<std::string>& words);

/// Text in double quotes on one line: control characters become blanks, a long text is shortened
/// between words.
std::string quote(std::string_view text);

}  // namespace breccia
