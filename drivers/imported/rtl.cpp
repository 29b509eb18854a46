#include "drivers/imported/rtl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "schema/base/number/number.h"
#include "schema/base/trimmed.h"
#include "schema/units.h"

namespace mdof::drivers {
namespace {

constexpr std::size_t kMostTargets = 100'000, kMostRtlRuns = 1000;

constexpr const char* kConvertAngles =
    "but the scale of angles in these files is not public; convert the file to CSV with columns "
    "position_mm,deviation_urad, and import the CSV file as the measured error, such as EBX";

constexpr const char* kNotPositioning =
    "; give the name of the measured error at the import, such as EYX. If the file does contain "
    "positioning errors, give EXX, EYY or EZZ";

std::string utf8_from_latin1(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xC0 | (byte >> 6));
      out += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return out;
}

std::optional<double> number_from(std::string_view word) {
  double x = 0;
  const char* const end = parse_double(word.data(), word.data() + word.size(), x);
  if (end != word.data() + word.size() || !std::isfinite(x)) return std::nullopt;
  return x;
}

// Returns an integer from 1 to `most`; 0: the word is not such an integer.
std::size_t count_from(std::string_view word, std::size_t most) {
  const auto x = number_from(word);
  if (!x || *x != std::floor(*x) || *x < 1 || *x > static_cast<double>(most)) return 0;
  return static_cast<std::size_t>(*x);
}

bool contains_word(std::string_view text, std::string_view lower_case) {
  const auto same = [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a + ('a' - 'A')) : a) == b;
  };
  return std::search(text.begin(), text.end(), lower_case.begin(), lower_case.end(), same) !=
         text.end();
}

// Returns the texts before and after the first colon of a line "key : value".
std::pair<std::string_view, std::string_view> key_and_value(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon == line.npos) return {trimmed(line), {}};
  return {trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1))};
}

class Rtl {
 public:
  Rtl(const std::string& source, bool error_is_stated)
      : source_(source), error_is_stated_(error_is_stated) {
    series_.format = "rtl";
    series_.source = source;
  }

  Status take(std::string_view line) {
    ++line_;
    line = trimmed(line);
    if (line.empty()) return {};
    if (line.ends_with("::")) {
      section_ = std::string(line.substr(0, line.size() - 2));
      in_targets_ = in_deviations_ = false;
      return {};
    }
    if (section_ == "HEADER" || section_ == "USER-TEXT") return take_description(line);
    if (section_ == "TARGET DATA") return take_target_line(line);
    if (section_ == "RUNS") return take_run_count(line);
    if (section_ == "DEVIATIONS") return take_deviation_line(line);
    return {};  // the sections EQUIPMENT and ENVIRONMENT are not read
  }

  Result<ImportedSeries> finish() {
    if (section_.empty())
      return bad_input(source_ +
                       ": has no section line such as \"TARGET DATA::\"; this is not an .rtl file");
    if (targets_.empty() || targets_.size() != target_count_)
      return bad_input(source_ + ": has " + std::to_string(targets_.size()) +
                       " targets, but Target-count is " + std::to_string(target_count_));
    const bool descending = targets_.size() > 1 && targets_[1] < targets_[0];
    for (std::size_t i = 1; i < targets_.size(); ++i)
      if (descending ? !(targets_[i] < targets_[i - 1]) : !(targets_[i] > targets_[i - 1]))
        return bad_input(source_ + ": target " + std::to_string(i + 1) + " is not " +
                         (descending ? "less" : "greater") +
                         " than the previous target, so forward and reverse runs cannot be "
                         "distinguished");
    if (series_.readings.size() != run_count_ * target_count_)
      return bad_input(source_ + ": has " + std::to_string(series_.readings.size()) +
                       " deviations instead of " + std::to_string(run_count_ * target_count_) +
                       " (Run-count " + std::to_string(run_count_) + " times Target-count " +
                       std::to_string(target_count_) + ")");
    MDOF_CHECK(drop_unmeasured_runs(descending));
    for (ImportedReading& reading : series_.readings) {
      reading.position_m = from_mm(targets_[static_cast<std::size_t>(reading.position_m)]);
      if (descending) reading.direction = -reading.direction;
    }
    if (descending) series_.notices.push_back(notice(NoticeCode::import_targets_sorted));
    return std::move(series_);
  }

 private:
  tl::unexpected<Error> wrong(const std::string& what) const {
    return bad_input(source_ + ":" + std::to_string(line_) + ": " + what);
  }

  Status take_description(std::string_view line) {
    const auto [key, value] = key_and_value(line);
    // Known types are "Linear", "Angular", "Rotary" and "Straightness".
    if (key == "File type" || key == "Owner") MDOF_CHECK(check_linear(key, value));
    if (!value.empty())
      series_.about.push_back(utf8_from_latin1(key) + ": " + utf8_from_latin1(value));
    return {};
  }

  Status check_linear(std::string_view key, std::string_view value) const {
    for (const char* const angle : {"angular", "rotary"})
      if (contains_word(value, angle))
        return wrong(std::string(key) + " \"" + utf8_from_latin1(value) +
                     "\" means that the file contains angles, " + kConvertAngles);
    for (const char* const other : {"straight", "flat", "square"})
      if (!error_is_stated_ && contains_word(value, other))
        return wrong(std::string(key) + " \"" + utf8_from_latin1(value) +
                     "\" means that the file contains no positioning errors" + kNotPositioning);
    return {};
  }

  Status take_target_line(std::string_view line) {
    const auto [key, value] = key_and_value(line);
    if (key == "Filetype") MDOF_CHECK(check_linear(key, value));
    // The meaning of the flags is not public; they are stored with the run.
    if (key == "Flags" && !value.empty())
      series_.about.push_back("Flags: " + utf8_from_latin1(value));
    if (key == "Target-count") {
      if (target_count_ > 0)
        return wrong("Target-count is given twice, but a file has one list of targets");
      target_count_ = count_from(value, kMostTargets);
      return target_count_ > 0 ? Status()
                               : wrong("Target-count must be a whole number from 1 to " +
                                       std::to_string(kMostTargets));
    }
    if (key == "Targets" || key == "Flags" || key == "Filetype") {
      in_targets_ = key == "Targets";
      if (!in_targets_) return {};
      line = value;
    }
    if (!in_targets_) return {};
    for (const std::string_view word : words_of(line)) {
      const auto target = number_from(word);
      if (!target)
        return wrong("target \"" + utf8_from_latin1(word) + "\" is not a number (in mm)");
      if (targets_.size() == kMostTargets)
        return wrong("more than " + std::to_string(kMostTargets) + " targets");
      targets_.push_back(*target);
    }
    return {};
  }

  Status take_run_count(std::string_view line) {
    const auto [key, value] = key_and_value(line);
    if (key != "Run-count") return {};
    if (run_count_ > 0) return wrong("Run-count is given twice, but a file has one set of runs");
    run_count_ = count_from(value, kMostRtlRuns);
    return run_count_ > 0 ? Status()
                          : wrong("Run-count must be a whole number from 1 to " +
                                  std::to_string(kMostRtlRuns));
  }

  Status take_deviation_line(std::string_view line) {
    if (key_and_value(line).first == "Run Target Data") {
      in_deviations_ = true;
      return {};
    }
    if (!in_deviations_) return {};
    const auto words = words_of(line);
    if (words.size() != 3)
      return wrong("a deviation line must contain the run, the target and the deviation in µm");
    const std::size_t run = count_from(words[0], run_count_),
                      target = count_from(words[1], target_count_);
    const auto deviation_um = number_from(words[2]);
    if (run == 0 || target == 0 || !deviation_um)
      return wrong("the line must contain a run from 1 to " + std::to_string(run_count_) +
                   ", a target from 1 to " + std::to_string(target_count_) +
                   " and a deviation in µm");
    MDOF_CHECK(check_run_direction(run, target));
    if (seen_.size() == kMostImportedReadings)
      return wrong("more than " + std::to_string(kMostImportedReadings) + " deviations");
    if (!seen_.insert({run, target}).second)
      return wrong("run " + std::to_string(run) + " already has a deviation at target " +
                   std::to_string(target));
    const bool forward = run % 2 == 1;
    series_.readings.push_back({static_cast<double>(target - 1), forward ? 1 : -1,
                                static_cast<int>((run + 1) / 2), from_um(*deviation_um)});
    return {};
  }

  // Only the run number states whether a run is forward or reverse. Therefore the order of the
  // targets must agree with the run number.
  Status check_run_direction(std::size_t run, std::size_t target) {
    const bool same = run == last_run_;
    const bool right = run % 2 == 1 ? target > last_target_ : target < last_target_;
    last_run_ = run;
    const std::size_t before = std::exchange(last_target_, target);
    if (!same || right) return {};
    return wrong(
        "run " + std::to_string(run) + " goes from target " + std::to_string(before) + " to " +
        std::to_string(target) +
        ", but odd runs must go forward and even runs backward. If the test was unidirectional, "
        "convert the file to CSV with columns target_mm,direction,run,deviation_um");
  }

  // For runs that were not measured, programs write zeros; examples are the reverse runs of a
  // unidirectional test. If exactly the runs of one direction contain only zeros, these runs are
  // removed, and the other direction is the complete test.
  Status drop_unmeasured_runs(bool descending) {
    std::vector<bool> measured(run_count_ + 1, target_count_ < 2);
    for (const ImportedReading& r : series_.readings)
      if (r.deviation != 0) measured[number_of(r)] = true;
    // Number of runs with zeros and number of runs; index 0: even runs, 1: odd runs.
    std::array<std::size_t, 2> filled{}, runs{};
    std::size_t first = 0;
    for (std::size_t run = 1; run <= run_count_; ++run) {
      ++runs[run % 2];
      if (measured[run]) continue;
      ++filled[run % 2];
      if (first == 0) first = run;
    }
    if (first == 0) return {};
    const std::size_t odd = first % 2;
    if (filled[odd] != runs[odd] || filled[1 - odd] > 0 || runs[1 - odd] == 0)
      return bad_input(
          source_ + ": run " + std::to_string(first) + " (" + (odd == 1 ? "forward" : "reverse") +
          ") has a deviation of exactly 0 at every target, so this run was not measured; write "
          "the measured runs as CSV with columns target_mm,direction,run,deviation_um");
    std::erase_if(series_.readings,
                  [&](const ImportedReading& r) { return number_of(r) % 2 == odd; });
    series_.notices.push_back(
        notice(NoticeCode::import_one_approach, "",
               {{"approach", (odd == 1) == descending ? "reverse" : "forward"},
                {"runs", static_cast<std::int64_t>(filled[odd])}}));
    return {};
  }
  // Returns the number of the run in the file.
  static std::size_t number_of(const ImportedReading& r) {
    return 2 * static_cast<std::size_t>(r.run) - (r.direction > 0 ? 1 : 0);
  }

  std::string source_, section_;
  bool error_is_stated_;
  std::uint64_t line_ = 0;
  bool in_targets_ = false, in_deviations_ = false;
  std::size_t target_count_ = 0, run_count_ = 0, last_run_ = 0, last_target_ = 0;
  std::vector<double> targets_;  // mm
  std::set<std::pair<std::size_t, std::size_t>> seen_;
  // position_m contains the index of the target until all targets are known.
  ImportedSeries series_;
};

}  // namespace

Result<ImportedSeries> parse_rtl(std::string_view text, const std::string& source,
                                 bool error_is_stated) {
  const std::string_view name = source;
  const std::string_view ending = name.size() < 4 ? "" : name.substr(name.size() - 4);
  if (contains_word(ending, ".rta"))
    return bad_input(source + ": an .rta file contains angles, " + kConvertAngles);
  // The last letter of the extension shows the kind of test: l is linear.
  if (!error_is_stated && contains_word(ending.substr(0, 3), ".rt") &&
      !contains_word(ending, ".rtl"))
    return bad_input(source + ": a file that ends in " + std::string(ending) +
                     " contains no positioning errors" + kNotPositioning);
  Rtl rtl(source, error_is_stated);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    MDOF_CHECK(rtl.take(text.substr(0, end)));
    text = end == text.npos ? std::string_view() : text.substr(end + 1);
  }
  return rtl.finish();
}

}  // namespace mdof::drivers
