// mdof export RECORDING: raw samples of a recording as CSV, for other programs.
#include <CLI/CLI.hpp>
#include <map>

#include "drivers/recording/recording_log.h"
#include "schema/base/output/output_files.h"
#include "schema/rig/rig.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/csv/log_csv.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

constexpr const char* kStandardOutput = "-";
constexpr auto kToStandardOutput = static_cast<std::size_t>(-1);

struct ExportCommand {
  std::string recording, csv = kStandardOutput, rig;
};

// "OUT.csv", or "OUT-counter.csv" where there are several devices.
std::string file_of(const std::string& file, const std::string& device) {
  const std::size_t slash = file.rfind('/'), dot = file.rfind('.');
  const bool ends = dot != file.npos && (slash == file.npos || dot > slash);
  std::string name = device;
  for (char& c : name) c = c == '/' ? '_' : c;
  return file.substr(0, ends ? dot : file.npos) + "-" + name + (ends ? file.substr(dot) : "");
}

class Export {
 public:
  Export(const ExportCommand& command, drivers::RecordingLog& log) : command_(command), log_(log) {}

  Status run() {
    if (!command_.rig.empty()) {
      MDOF_TRY(const std::size_t rig, files_.add(command_.rig));
      MDOF_CHECK(files_.write(rig, log_.rig_text()));
    }
    SampleBlock block;
    for (;;) {
      MDOF_TRY(const auto state, log_.read(block, {}));
      if (block.scans() > 0) MDOF_CHECK(take(block));
      if (state == drivers::ReadState::end) break;
    }
    MDOF_CHECK(files_.publish());
    for (const auto& name : names_) say(name);
    show_notices(log_.notices(), true);
    tell_what_csv_cannot();
    return {};
  }

 private:
  Status take(const SampleBlock& block) {
    text_.clear();
    MDOF_TRY(const std::size_t file, file_for(block));
    append_log_csv(text_, block);
    marked_ += marked_values(block);
    lost_ += block.lost;
    return file == kToStandardOutput ? write_out(text_) : files_.write(file, text_);
  }

  // Begins text_ with the head where the file is a new one.
  Result<std::size_t> file_for(const SampleBlock& block) {
    if (const auto found = file_of_.find(block.device); found != file_of_.end())
      return found->second;
    const bool one = block.channels.size() == log_.info().channels.size();
    const bool to_standard_output = command_.csv == kStandardOutput;
    if (!one && to_standard_output)
      return fail(ErrorCode::usage, command_.recording +
                                        ": has several devices, each with its own times, and a "
                                        "CSV file each; name one with --csv OUT.csv");
    std::size_t file = kToStandardOutput;
    if (!to_standard_output) {
      const std::string name = one ? command_.csv : file_of(command_.csv, block.device);
      MDOF_TRY(file, files_.add(name));
      names_.push_back(name);
    }
    text_ = log_csv_head(comments(block.device), block.channels);
    return file_of_.emplace(block.device, file).first->second;
  }

  std::vector<std::string> comments(const std::string& device) const {
    std::vector<std::string> lines{"recording: " + command_.recording, "sha256: " + log_.sha256(),
                                   "started: " + log_.header().started_utc, "device: " + device};
    if (log_.simulated()) lines.emplace_back("simulated data: no machine was measured");
    const auto rig = parse_rig(log_.rig_text(), command_.recording);
    if (rig) lines.push_back(std::string("axis: ") + letter(rig->axis));
    return lines;
  }

  void tell_what_csv_cannot() const {
    if (marked_ > 0)
      warn(std::to_string(marked_) +
           " values are over range, suspect or stale; a CSV log cannot say which");
    if (lost_ > 0)
      warn(std::to_string(lost_) + " scans were lost in recording; there the times have a gap");
    if (file_of_.size() > 1)
      say("a file each device: their times are of one clock, but mdof replay takes the recording");
  }

  const ExportCommand& command_;
  drivers::RecordingLog& log_;
  OutputFiles files_{Existing::replace};
  std::map<std::string, std::size_t> file_of_;  // by device
  std::vector<std::string> names_;
  std::string text_;
  std::uint64_t marked_ = 0, lost_ = 0;
};

Status export_recording(const ExportCommand& command) {
  drivers::RecordingLog log("recording", command.recording);
  MDOF_CHECK(log.open());
  return Export(command, log).run();
}

Action declare_export(CLI::App& command) {
  const auto o = std::make_shared<ExportCommand>();
  command.add_option("RECORDING", o->recording, "FILE.mdofrec")->required()->type_name("");
  command
      .add_option("--csv", o->csv,
                  "Where to; of several devices each has a file, OUT-device.csv [default: "
                  "standard output]")
      ->type_name("OUT.csv");
  command.add_option("--rig", o->rig, "Write its rig there, for mdof replay")
      ->type_name("RIG.toml");
  return [o] { return export_recording(*o); };
}

}  // namespace

Command export_command() {
  return {.name = "export",
          .summary = "Write the raw samples of a recording as CSV",
          .footer =
              "Example:\n"
              "  mdof export run-12.mdofrec --csv log_X.csv --rig rig_X.toml\n"
              "  mdof replay log_X.csv --rig rig_X.toml --no-store",
          .declare = declare_export};
}

}  // namespace mdof::tools
