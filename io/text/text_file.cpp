#include "io/text/text_file.hpp"

#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "core/base/error.hpp"
#include "io/text/input_file.hpp"
#include "io/text/suggest.hpp"

namespace breccia {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

}  // namespace

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string read_text(const std::filesystem::path& file) {
  std::string text = read_bytes(file);
  if (trim(text).empty()) fail<BadInput>("{}: the file is empty", file.string());
  return text;
}

bool LineReader::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line = trim(rest_.substr(0, end));
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  ++number_;
  return true;
}

std::string LineReader::place() const { return fmt::format("{}:{}", name_, number_); }

double to_number(std::string_view field, std::string_view what, const LineReader& at) {
  std::string_view digits = field;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
    fail<BadInput>("{}: {} {} is not a number", at.place(), what, quote(field));
  if (error != std::errc{} || !std::isfinite(value))
    fail<BadInput>("{}: {} {} is not a finite number", at.place(), what, quote(field));
  return value;
}

std::uint64_t to_id(std::string_view field, std::string_view what, const LineReader& at) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size())
    fail<BadInput>("{}: {} {} is not a whole number from 0", at.place(), what, quote(field));
  return value;
}

int to_group(std::string_view field, const LineReader& at) {
  const double value = to_number(field, "group", at);
  if (value < 0 || value > std::numeric_limits<int>::max() || std::floor(value) != value)
    fail<BadInput>("{}: group {} is not a whole number from 0", at.place(), quote(field));
  return static_cast<int>(value);
}

}  // namespace breccia
