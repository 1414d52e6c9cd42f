// A text file read at once and walked through line by line, field by field.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace breccia {

/// The whole file. @throws BadInput: absent, no file (a folder, a pipe), unreadable, empty
std::string read_text(const std::filesystem::path& file);

/// Walks through a text; every error names the file and the line.
class LineReader {
public:
  LineReader(std::string name, std::string_view text) : name_(std::move(name)), rest_(text) {}

  /// Next line without its end and without blanks around it; false at the end of the text.
  bool next(std::string_view& line);
  std::size_t line_number() const { return number_; }
  std::string place() const;

private:
  std::string name_;
  std::string_view rest_;
  std::size_t number_ = 0;
};

std::string_view trim(std::string_view);

/// @throws BadInput: place, what the field is, what is wrong
double to_number(std::string_view field, std::string_view what, const LineReader&);
std::uint64_t to_id(std::string_view field, std::string_view what, const LineReader&);
int to_group(std::string_view field, const LineReader&);

}  // namespace breccia
