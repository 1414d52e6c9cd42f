#include "drivers/studies/workprecision/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <cerrno>
#include <sstream>

#include "core/base/error.hpp"
#include "io/files/atomic_write.hpp"
#include "io/files/write_error.hpp"
#include "io/text/text_file.hpp"

namespace breccia {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// JSON has no NaN: null stands for it.
double number(const Json& json, const char* name) {
  const Json& value = json.at(name);
  return value.is_null() ? Readings::none : value.get<double>();
}

Json json_of(const Outcome& o) {
  return {{"failure", o.failure},
          {"peak_reached", o.peak_reached},
          {"peak_Pa", o.readings.peak},
          {"young_Pa", o.readings.young},
          {"strain_at_peak", o.readings.strain_at_peak},
          {"run_time_s", o.run_time},
          {"steps", o.steps},
          {"time_step_s", o.time_step},
          {"critical_time_step_s", o.critical_time_step},
          {"kinetic_ratio", o.kinetic_ratio},
          {"platen_mismatch", o.platen_mismatch},
          {"spheres", o.spheres},
          {"bonds", o.bonds},
          {"strain", o.readings.curve.strain},
          {"stress_Pa", o.readings.curve.stress}};
}

Outcome outcome_of(const Json& json) {
  Outcome o;
  o.failure = json.at("failure").get<std::string>();
  o.peak_reached = json.at("peak_reached").get<bool>();
  o.readings = {
      number(json, "peak_Pa"),
      number(json, "young_Pa"),
      number(json, "strain_at_peak"),
      {json.at("strain").get<std::vector<double>>(), json.at("stress_Pa").get<std::vector<double>>()}};
  o.run_time = number(json, "run_time_s");
  o.steps = json.at("steps").get<std::uint64_t>();
  o.time_step = number(json, "time_step_s");
  o.critical_time_step = number(json, "critical_time_step_s");
  o.kinetic_ratio = number(json, "kinetic_ratio");
  o.platen_mismatch = number(json, "platen_mismatch");
  o.spheres = json.at("spheres").get<std::uint64_t>();
  o.bonds = json.at("bonds").get<std::uint64_t>();
  return o;
}

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json json_of(const JournalHead& head) {
  Json json;
  for (const auto& [name, value] : head) json[name] = value;
  return json;
}

/// The file up to its last whole line.
std::string whole_lines(const fs::path& file) {
  std::string text = read_text(file);
  text.resize(text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1);
  return text;
}

void check_head(const fs::path& file, const JournalHead& head, const Json& found) {
  for (const auto& [name, value] : head) {
    const auto at = found.find(name);
    const std::string there = at != found.end() && at->is_string() ? at->get<std::string>() : "?";
    if (there != value)
      fail<BadInput>(
          "{}: its runs are of another {} ({}, now {}); choose another folder with --out, or "
          "--force in place of --resume",
          file.string(), name, there, value);
  }
}

std::map<std::string, Outcome> read_runs(const fs::path& file, const JournalHead& head,
                                         const std::string& text) {
  std::map<std::string, Outcome> runs;
  std::istringstream lines(text);
  std::string line;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    try {
      const Json json = Json::parse(line);
      if (number == 1)
        check_head(file, head, json);
      else
        runs[json.at("key").get<std::string>()] = outcome_of(json);
    } catch (const Json::exception&) {
      fail<BadInput>(
          "{}:{}: is no run of breccia-workprecision; remove the line, or begin again with --force",
          file.string(), number);
    }
  }
  return runs;
}

/// Appends; what is there stays as it is whatever happens. 0, or errno.
int append(const fs::path& file, std::string_view text) {
  const int out = ::open(file.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (out < 0) return errno;
  int error = 0;
  while (!text.empty() && error == 0) {
    const ssize_t written = ::write(out, text.data(), text.size());
    if (written >= 0)
      text.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      error = errno;
  }
  if (::close(out) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

Journal::Journal(fs::path file, const JournalHead& head, bool resume) : file_(std::move(file)) {
  std::string text;
  std::error_code ignored;
  if (resume && fs::exists(file_, ignored)) {
    text = whole_lines(file_);
    done_ = read_runs(file_, head, text);
  }
  atomic_write(file_, text.empty() ? line_of(json_of(head)) : text);
}

const Outcome* Journal::find(const std::string& key) const {
  const auto at = done_.find(key);
  return at == done_.end() ? nullptr : &at->second;
}

void Journal::add(const std::string& key, const Outcome& outcome) {
  Json json{{"key", key}};
  json.update(json_of(outcome));
  if (const int error = append(file_, line_of(json)); error != 0) fail_to_write(file_, error);
  flush_to_disk(file_);
  done_[key] = outcome;
}

std::string hash_of_case(const Case& c) {
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  const auto add = [&hash](std::string_view text) {
    for (const char byte : text) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  };
  add(c.resolved);
  add(BRECCIA_VERSION);
  if (c.specimen.file) add(read_text(*c.specimen.file));
  return fmt::format("{:016x}", hash);
}

}  // namespace breccia
