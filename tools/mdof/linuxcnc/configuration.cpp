#include "tools/mdof/linuxcnc/configuration.h"

#include <charconv>

#include "schema/base/files.h"
#include "schema/base/trimmed.h"

namespace mdof::tools {
namespace {

namespace fs = std::filesystem;

constexpr int kMostNestedFiles = 8;

std::vector<std::string> joined_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::string joined;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = trimmed(std::string_view(text).substr(at, end - at));
    at = end + 1;
    const bool continues = line.ends_with('\\');
    joined += continues ? std::string(line.substr(0, line.size() - 1)) + " " : std::string(line);
    lines.emplace_back();  // a line that continues on the next line becomes an empty line, so that
                           // line numbers do not change
    if (!continues) std::swap(lines.back(), joined);
  }
  // The last line of the file ends with a backslash.
  if (!joined.empty()) lines.back() = std::move(joined);
  return lines;
}

Status read_ini_line(LinuxCncIni& ini, std::string_view line, int number, std::string& section) {
  const std::string place = ini.file.string() + ":" + std::to_string(number) + ": ";
  if (line.starts_with("#INCLUDE"))
    return bad_input(place + "#INCLUDE is not supported; give an INI file that contains all lines");
  if (line.empty() || line.front() == '#' || line.front() == ';') return {};
  const std::size_t equals = line.find('=');
  if (line.front() == '[' && line.back() == ']') {
    section = trimmed(line.substr(1, line.size() - 2));
  } else if (equals == line.npos || equals == 0) {
    return bad_input(place +
                     "the line is neither [SECTION], KEY = VALUE nor a comment; correct this line");
  } else {
    ini.entries.push_back({section, std::string(trimmed(line.substr(0, equals))),
                           std::string(trimmed(line.substr(equals + 1))), number});
  }
  return {};
}

class HalReader {
 public:
  HalReader(const LinuxCncIni& ini, HalWiring& wiring)
      : folder_(ini.file.parent_path()), wiring_(wiring) {}

  Status read(const std::string& name, int depth = 0) {
    if (name.starts_with("LIB:") || name.ends_with(".tcl")) {
      wiring_.not_read.push_back(name);
      return {};
    }
    const fs::path file = folder_ / name;
    if (depth > kMostNestedFiles)
      return bad_input(
          file.string() + ": more than " + std::to_string(kMostNestedFiles) +
          " nested files; check that no HAL file sources itself, directly or through another file");
    MDOF_TRY(const std::string text, read_text_file(file));
    int number = 0;
    for (const std::string& line : joined_lines(text)) {
      ++number;
      const auto words = words_of(std::string_view(line).substr(0, line.find('#')));
      if (words.empty()) continue;
      if (auto done = take(words, depth); !done)
        return in_context(file.string() + ":" + std::to_string(number), std::move(done.error()));
    }
    return {};
  }

 private:
  Status take(const std::vector<std::string_view>& words, int depth) {
    const std::string_view command = words[0];
    if (command == "source" && words.size() > 1) return read(std::string(words[1]), depth + 1);
    if (command == "addf" && words.size() > 2) return add_function(words);
    if (command == "net" && words.size() > 2) {
      for (std::size_t i = 2; i < words.size(); ++i) link(words[i], words[1]);
    } else if (command == "linkps" || command == "linksp") {
      std::vector<std::string_view> names;
      for (std::size_t i = 1; i < words.size(); ++i)
        if (words[i] != "=>" && words[i] != "<=") names.push_back(words[i]);
      if (names.size() == 2) link(names[command == "linksp"], names[command == "linkps"]);
    } else if (command == "unlinkp" && words.size() > 1) {
      wiring_.signal_of.erase(std::string(words[1]));
    }
    return {};
  }

  void link(std::string_view pin, std::string_view signal) {
    if (pin != "=>" && pin != "<=" && pin != "<=>")
      wiring_.signal_of[std::string(pin)] = std::string(signal);
  }

  // words[3] is the position: 1 is the first in the thread, -1 (the default) the last.
  Status add_function(const std::vector<std::string_view>& words) {
    const std::string thread(words[2]);
    std::vector<std::size_t> of_thread;
    for (std::size_t i = 0; i < wiring_.functions.size(); ++i)
      if (wiring_.functions[i].thread == thread) of_thread.push_back(i);
    int place = -1;
    const auto count = static_cast<int>(of_thread.size());
    if (words.size() > 3) {
      const char* end = words[3].data() + words[3].size();
      const auto [last, error] = std::from_chars(words[3].data(), end, place);
      if (error != std::errc() || last != end || place == 0 || place > count + 1 ||
          place < -count - 1)
        return bad_input("addf: \"" + std::string(words[3]) +
                         "\" is not a position in the thread " + thread +
                         "; give a number from 1 to " + std::to_string(count + 1) +
                         ", or from -1 to -" + std::to_string(count + 1));
    }
    const auto before = static_cast<std::size_t>(place > 0 ? place - 1 : count + 1 + place);
    const std::size_t at = before < of_thread.size() ? of_thread[before] : wiring_.functions.size();
    wiring_.functions.insert(wiring_.functions.begin() + static_cast<std::ptrdiff_t>(at),
                             {std::string(words[1]), thread});
    return {};
  }

  fs::path folder_;
  HalWiring& wiring_;
};

}  // namespace

const IniEntry* LinuxCncIni::find(const std::string& section, const std::string& key) const {
  for (const IniEntry& entry : entries)
    if (entry.section == section && entry.key == key) return &entry;
  return nullptr;
}

std::vector<const IniEntry*> LinuxCncIni::all(const std::string& section,
                                              const std::string& key) const {
  std::vector<const IniEntry*> found;
  for (const IniEntry& entry : entries)
    if (entry.section == section && entry.key == key) found.push_back(&entry);
  return found;
}

std::string LinuxCncIni::value(const std::string& section, const std::string& key) const {
  const IniEntry* entry = find(section, key);
  return entry ? entry->value : "";
}

Result<bool> is_inch_machine(const LinuxCncIni& ini) {
  const std::string unit = ini.value("TRAJ", "LINEAR_UNITS");
  if (unit == "inch" || unit == "in" || unit == "imperial") return true;
  if (unit == "mm" || unit == "metric") return false;
  return bad_input("[TRAJ]LINEAR_UNITS = \"" + unit + "\" is neither mm nor inch");
}

Result<std::vector<AxisJoint>> trivkins_joints(const LinuxCncIni& ini) {
  const std::string text = ini.value("KINS", "KINEMATICS");
  const auto words = words_of(text);
  if (words.empty() || words[0] != "trivkins")
    return bad_input("[KINS]KINEMATICS = \"" + text +
                     "\" must be trivkins; with other kinematics a joint is not an axis, so joints "
                     "cannot be compensated one by one");
  std::string letters = "XYZABCUVW";
  for (const std::string_view word : words)
    if (word.starts_with("coordinates=")) letters = word.substr(word.find('=') + 1);
  for (char& letter : letters)
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  std::vector<AxisJoint> joints;
  for (const char axis : std::string_view("XYZ"))
    for (std::size_t joint = letters.find(axis); joint != std::string::npos;
         joint = letters.find(axis, joint + 1))
      joints.push_back({axis, static_cast<int>(joint)});
  return joints;
}

Result<LinuxCncIni> read_linuxcnc_ini(const fs::path& file) {
  LinuxCncIni ini{file, {}};
  MDOF_TRY(const std::string text, read_text_file(file));
  std::string section;
  int number = 0;
  for (const std::string& line : joined_lines(text))
    MDOF_CHECK(read_ini_line(ini, line, ++number, section));
  return ini;
}

std::string HalWiring::signal(const std::string& pin, const std::string& otherwise) const {
  const auto found = signal_of.find(pin);
  return found == signal_of.end() ? otherwise : found->second;
}

Result<HalWiring> read_hal_files(const LinuxCncIni& ini, const std::string& leave_out) {
  HalWiring wiring;
  HalReader reader(ini, wiring);
  for (const char* key : {"HALFILE", "POSTGUI_HALFILE"})
    for (const IniEntry* entry : ini.all("HAL", key)) {
      const auto words = words_of(entry->value);
      if (words.empty() || fs::path(words[0]).filename() == leave_out) continue;
      MDOF_CHECK(reader.read(std::string(words[0])));
    }
  return wiring;
}

}  // namespace mdof::tools
