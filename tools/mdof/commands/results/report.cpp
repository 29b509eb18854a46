// mdof report RUN...: writes a report of stored runs as one HTML file.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "daemon/output/documents/dcc.h"
#include "daemon/words/error_text.h"
#include "schema/base/files.h"
#include "schema/base/json_writer.h"
#include "schema/base/output/output_files.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/report/print_pdf.h"
#include "tools/mdof/report/report_of_runs.h"
#include "tools/mdof/stored/run_choice.h"

namespace mdof::tools {
namespace {

struct ReportCommand {
  ReportRequest request;
  std::string out, language = "en", head;
  bool pdf = false, json = false;
};

constexpr std::size_t kLongestHead = 1 << 20;

// Reads the HTML that the user's company puts at the top of the report. Error: it contains a
// comment or a script, because these could hide required content.
Result<std::string> company_head(const std::string& file) {
  if (file.empty()) return std::string();
  MDOF_TRY(std::string head, read_text_file(file, kLongestHead));
  std::string lower = head;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const char* refused : {"<script", "<!--", "<style", "<body", "</body", "</html", "<html"})
    if (lower.find(refused) != std::string::npos)
      return bad_input(file + ": the HTML of a letterhead must not contain \"" + refused +
                       "\"; an example of a letterhead: "
                       "<img src=\"data:image/png;base64,...\"><p>Muster AG</p>");
  return head + "\n";
}

// Attaches the document that mdof export --format dcc writes, with the same bytes.
void attach_certificate(report::Report& report) {
  const auto dcc = documents::dcc_xml(report);
  if (dcc)
    report.attachments.push_back({"certificate.xml", "application/xml", *dcc});
  else
    say("the report contains no certificate (DCC): " + words::text(dcc.error()));
}

Status write_report(const ReportCommand& command) {
  const std::filesystem::path out = command.out;
  if (out.extension() == ".pdf")
    return fail(ErrorCode::usage, "--out " + command.out +
                                      ": the report is an HTML file; give --out FILE.html, and "
                                      "--pdf to write FILE.pdf beside the HTML file");
  MDOF_TRY(report::Report report, report_of_runs(command.request));
  output::language_from(command.language, report.language);  // the option accepts only valid names
  MDOF_TRY(report.head, company_head(command.head));
  attach_certificate(report);
  MDOF_CHECK(write_file(command.out, report::report_html(report), Existing::replace));
  print_report_marks(report);
  const std::string pdf =
      command.pdf ? std::filesystem::path(out).replace_extension(".pdf").string() : "";
  if (command.pdf) {
    MDOF_CHECK(print_pdf(command.out, pdf));
    for (const report::Attachment& file : report.attachments)
      MDOF_CHECK(attach_to_pdf(pdf, file.file_name, file.media_type, file.bytes));
  }
  if (!command.json) return write_line(command.out + (pdf.empty() ? "" : "\n" + pdf));
  JsonWriter json;
  json.begin_object().field("file", command.out);
  if (command.pdf) json.field("pdf", pdf);
  json.end_object();
  return write_line(json.take());
}

Action declare_report(CLI::App& command) {
  const auto o = std::make_shared<ReportCommand>();
  add_run_arguments(command, o->request.runs, "Numbers of the runs (see mdof runs), or \"latest\"");
  command.add_option("--out", o->out, "Output file of the report; mdof replaces an existing file")
      ->required()
      ->type_name("FILE.html");
  add_report_options(command, o->request);
  command
      .add_option("--template", o->head,
                  "HTML file with the company letterhead, placed at the top of the report")
      ->type_name("FILE.html");
  command.add_flag(
      "--before-after", o->request.before_after,
      "Add the change between two runs of each axis, with U; give the run before the change first");
  command.add_flag("--pdf", o->pdf,
                   "Also write the report as FILE.pdf (needs chromium or weasyprint, and qpdf to "
                   "attach the DCC)");
  add_language_option(command, o->language);
  add_json_flag(command, o->json);
  return [o] { return write_report(*o); };
}

}  // namespace

Command report_command() {
  return {
      .name = "report",
      .summary = "Write a report of stored runs as one HTML file (A4 when printed)",
      .footer =
          "The report needs no other file and has no script. It contains title, results with u, U\n"
          "and k, decisions, conditions, fixture, calibrations, notices, charts, points, and how\n"
          "to replay the recording. If the country of the laboratory is given, the report also\n"
          "contains the DCC of mdof export. The same results give the same bytes. For an imported\n"
          "run, the report contains the readings, the figures of ISO 230-2 with u, U and k, and\n"
          "how to import the run again.\n"
          "\n"
          "Examples:\n"
          "  mdof report 12 --out report.html --set customer=\"Muster AG\" --set serial_number=17\n"
          "  mdof report 1 2 --out bericht.html --language de\n"
          "  mdof report 12 17 --before-after --out report.html --set country=DE\n"
          "  mdof report 12 --out report.html --tolerance EYX_straightness_um=0.5",
      .declare = declare_report};
}

}  // namespace mdof::tools
