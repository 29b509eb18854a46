// mdof export: writes raw samples of a recording as CSV, or results of runs as a document, for
// other programs.
#include <CLI/CLI.hpp>
#include <map>

#include "daemon/output/documents/dcc.h"
#include "daemon/output/documents/qif.h"
#include "drivers/recording/recording_log.h"
#include "schema/base/output/output_files.h"
#include "schema/rig/rig.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/results/chosen_run.h"
#include "tools/mdof/csv/log_csv.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/report/report_of_runs.h"
#include "tools/mdof/stored/run_choice.h"
#include "tools/mdof/text/notice_lines.h"

namespace mdof::tools {
namespace {

constexpr const char* kStandardOutput = "-";
constexpr auto kToStandardOutput = static_cast<std::size_t>(-1);

struct ExportCommand {
  std::string recording, csv = kStandardOutput, rig;
  std::string format = "csv", out;  // used only for runs
  std::vector<std::string> sources;
  ReportRequest request;
};

// The name of the output file for one device: "OUT.csv", or "OUT-counter.csv" if there are several
// devices.
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
    report_missing_from_csv();
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

  // The number of the output file for this device. If the file is new, sets text_ to its header.
  Result<std::size_t> file_for(const SampleBlock& block) {
    if (const auto found = file_of_.find(block.device); found != file_of_.end())
      return found->second;
    const bool one = block.channels.size() == log_.info().channels.size();
    const bool to_standard_output = command_.csv == kStandardOutput;
    if (!one && to_standard_output)
      return fail(ErrorCode::usage, command_.recording +
                                        ": the recording has several devices, and each device "
                                        "needs its own CSV file; give --csv OUT.csv");
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

  void report_missing_from_csv() const {
    if (marked_ > 0)
      warn(std::to_string(marked_) +
           " values are over range, suspect or stale; the CSV file does not mark them");
    if (lost_ > 0)
      warn(std::to_string(lost_) +
           " scans were lost during the recording; the times in the CSV file have gaps at these "
           "scans");
    if (file_of_.size() > 1)
      say("mdof wrote one file for each device, with times of a common clock; for \"mdof replay\", "
          "use the recording, not these files");
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

Result<std::string> document_text(const std::string& format, const report::Report& report) {
  if (format == "dcc") return documents::dcc_xml(report);
  return documents::qif_xml(report);
}

Status export_document(ExportCommand& command) {
  if (command.out.empty()) return fail(ErrorCode::usage, "missing option --out FILE");
  for (const std::string& word : command.sources)
    if (const std::string why = run_argument_error(word); !why.empty())
      return fail(ErrorCode::usage, "--format " + command.format + " takes runs: " + why);
  command.request.runs = command.sources;
  MDOF_TRY(const report::Report report, report_of_runs(command.request));
  MDOF_TRY(const std::string text, document_text(command.format, report));
  MDOF_CHECK(write_file(command.out, text, Existing::replace));
  print_report_marks(report);
  return write_line(command.out);
}

// Writes a run in the format of mdof show: points as CSV, or the complete run as JSON.
Status export_run(const ExportCommand& command) {
  const std::string& source = command.sources.front();
  if (const std::string why = run_argument_error(source); !why.empty())
    return fail(ErrorCode::usage, "--format " + command.format + " takes a run: " + why);
  if (!command.request.set.empty() || !command.request.tolerances.empty())
    return fail(ErrorCode::usage,
                "--set and --tolerance apply only to --format dcc and --format qif");
  ChosenRun choice;
  choice.axis = command.request.axis;
  choice.reference = command.request.reference;
  choice.database = command.request.database;
  choice.run = source;
  choice.out = command.out;
  choice.all_warnings = true;  // the command has no option --all-warnings
  choice.csv = command.format == "csv";
  choice.json = !choice.csv;
  return show_run(choice);
}

Status export_samples_or_run(ExportCommand& command) {
  if (command.sources.size() != 1)
    return fail(
        ErrorCode::usage,
        "--format csv takes exactly one recording (FILE.mdofrec) or one run, and --format json "
        "takes exactly one run; to export several runs, give --format dcc or --format qif");
  if (command.format == "json" || run_argument_error(command.sources.front()).empty())
    return export_run(command);
  if (!command.out.empty())
    return fail(ErrorCode::usage,
                "--out applies only to runs; give --csv OUT.csv for the samples of a recording");
  command.recording = command.sources.front();
  return export_recording(command);
}

Status export_as_requested(ExportCommand& command) {
  const bool is_document = command.format == "dcc" || command.format == "qif";
  return is_document ? export_document(command) : export_samples_or_run(command);
}

Action declare_export(CLI::App& command) {
  const auto o = std::make_shared<ExportCommand>();
  command
      .add_option("SOURCE", o->sources,
                  "Recording FILE.mdofrec, number of a run, or \"latest\"; --format dcc and "
                  "--format qif take one or more runs")
      ->required()
      ->type_name("");
  command
      .add_option("--format", o->format,
                  "csv: samples of a recording, or points of a run; json: all data of a run; dcc "
                  "(Digital Calibration Certificate 3.3.0) or qif (QIF 3.0): results of runs [csv]")
      ->check(CLI::IsMember({"csv", "json", "dcc", "qif"}))
      ->type_name("TEXT:{csv,json,dcc,qif}");
  auto* out = command
                  .add_option("--out", o->out,
                              "Output file for runs [default for csv and json: standard output]; "
                              "mdof replaces an existing file")
                  ->type_name("FILE");
  add_report_options(command, o->request);
  command
      .add_option(
          "--csv", o->csv,
          "CSV file to write; with several devices, one file OUT-device.csv for each device "
          "[default: standard output]")
      ->type_name("OUT.csv");
  command
      .add_option("--rig", o->rig,
                  "Write the rig of the recording to this file, for use with \"mdof replay\"")
      ->type_name("RIG.toml")
      ->excludes(out);
  return [o] { return export_as_requested(*o); };
}

}  // namespace

Command export_command() {
  return {
      .name = "export",
      .summary = "Write samples of a recording as CSV, or runs as CSV, JSON, DCC or QIF",
      .footer =
          "A DCC or QIF document is a test report. The document states that it is not a\n"
          "calibration certificate of an accredited laboratory. Missing\n"
          "entries read \"not stated\". A DCC needs the country. For a run from a CSV log\n"
          "without the line \"# started:\", it also needs the date. Give both with --set or in\n"
          "[report] of the rig.\n"
          "\n"
          "Examples:\n"
          "  mdof export run-12.mdofrec --csv log_X.csv --rig rig_X.toml\n"
          "  mdof replay log_X.csv --rig rig_X.toml --no-store\n"
          "  mdof export 1 --format json --out run.json\n"
          "  mdof export 1 2 --format dcc --out axes.xml --set country=DE --set date=2026-11-20",
      .declare = declare_export};
}

}  // namespace mdof::tools
