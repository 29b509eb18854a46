// mdof calibrate certificate DCC: writes a calibration record with the scale and the linearity that
// a laboratory's certificate (DCC) states for a probe.
#include <CLI/CLI.hpp>

#include "algo/calibration/certified_probe.h"
#include "daemon/words/words.h"
#include "schema/base/files.h"
#include "schema/base/json_writer.h"
#include "schema/base/sha256.h"
#include "schema/dcc/certificate.h"
#include "schema/notice/notice_json.h"
#include "schema/sample.h"
#include "schema/units.h"
#include "tools/mdof/commands/calibration/record_file.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/text/run_tables.h"

namespace mdof::tools {
namespace {

constexpr std::size_t kMostDccBytes = std::size_t{64}
                                      << 20;  // large, because a DCC may contain a PDF file

struct CertificateCommand {
  std::string file, rig, probe, result;
  RecordOptions record;
  bool json = false;
};

struct Certified {
  algo::CertifiedProbe found;
  CalibrationRecord record;
  DccCertificate certificate;
};

std::string json_of(const Certified& certified, const std::string& file) {
  const auto& [found, record, certificate] = certified;
  const CalibratedProbe& probe = found.probe;
  const CertificateFacts& facts = found.facts;
  const auto number = [](double x) { return x > 0 ? x : kNaN; };
  JsonWriter json;
  json.begin_object().field("kind", record.kind).field("rig", record.rig);
  json.field("probe", probe.id).field("certificate", facts.certificate);
  json.field("laboratory", facts.laboratory).field("item", certificate.item);
  json.field("serial_number", facts.serial_number).field("calibrated", facts.calibrated);
  json.field("due", facts.due).field("valid_until", record.valid_until).key("record");
  file.empty() ? json.null() : json.value(file);
  json.field("um_per_V", probe.um_per_V.value_or(kNaN));
  json.field("u_sensitivity_ppm", number(probe.u_sensitivity_1 * 1e6));
  json.field("offset_um", probe.offset_um.value_or(kNaN)).key("linearity").begin_array();
  for (const auto& [reading_um, correction_um] : probe.linearity)
    json.begin_array().value(reading_um).value(correction_um).end_array();
  json.end_array().field("u_linearity_um", number(to_um(facts.u_linearity_m)));
  write_notices(json, "taken", found.taken, words::text);
  write_notices(json, "not_taken", found.not_taken, words::text);
  json.field("signature", certificate.is_signed ? "not verified" : "none").end_object();
  return json.take();
}

std::string or_not_stated(const std::string& text) {
  return text.empty() ? "not stated" : text;
}

std::string text_of(const Certified& certified) {
  const auto& [found, record, certificate] = certified;
  const CalibratedProbe& probe = found.probe;
  const CertificateFacts& facts = found.facts;
  std::string text = "certificate " + facts.certificate + " of " + facts.laboratory + ", " +
                     facts.calibrated + "\ncalibrated item: " + or_not_stated(certificate.item) +
                     ", serial number " + or_not_stated(facts.serial_number) +
                     "\n"
                     "values taken from the certificate for probe " +
                     probe.id + ":\n";
  for (const Notice& each : found.taken) text += "- " + words::text(each) + "\n";
  text += "- valid until " + record.valid_until +
          (facts.due.empty()
               ? " (from --valid-days, because the certificate has no date of recalibration)\n"
               : " (date of recalibration in the certificate)\n");
  for (const Notice& each : found.not_taken) text += "not taken: " + words::text(each) + "\n";
  return text + (certificate.is_signed ? "The signature of the certificate is not verified.\n"
                                       : "The certificate is not signed.\n");
}

Result<Certified> read_certificate(const CertificateCommand& command) {
  MDOF_TRY(const Rig rig, load_rig(command.rig));
  const auto at = rig.probe_index(command.probe);
  if (!at)
    return fail(ErrorCode::usage, command.rig + ": the rig has no probe \"" + command.probe +
                                      "\"; the probes of the rig are " + probe_ids(rig));
  MDOF_TRY(const std::string text, read_text_file(command.file, kMostDccBytes));
  Certified certified;
  MDOF_TRY(certified.certificate, read_dcc(text, command.file));
  MDOF_TRY(certified.found, algo::certified_probe(rig, *at, certified.certificate, command.result));
  const std::string& due = certified.certificate.due;
  MDOF_TRY(auto record,
           begin_record("sensitivity", rig, command.record, certified.certificate.calibrated));
  if (!due.empty()) record.valid_until = due;
  record.sources = {{command.file, sha256_hex(text)}};
  for (const Notice& each : certified.found.not_taken) record.not_seen.push_back(words::text(each));
  record.probes = {certified.found.probe};
  certified.record = std::move(record);
  return certified;
}

Status take_certificate(const CertificateCommand& command) {
  MDOF_TRY(const Certified certified, read_certificate(command));
  const std::string& out = command.record.out;
  if (!out.empty())
    MDOF_CHECK(write_record(out, record_text(certified.record, certified.found.facts)));
  return command.json ? write_line(json_of(certified, out)) : write_out(text_of(certified));
}

Action declare_certificate(CLI::App& command) {
  const auto o = std::make_shared<CertificateCommand>();
  command.add_option("DCC", o->file, "Digital calibration certificate of the probe (PTB DCC 3.x)")
      ->required()
      ->type_name("");
  command.add_option("--rig", o->rig, "Rig file, which describes the probes and the encoder")
      ->required()
      ->type_name("RIG.toml");
  command.add_option("--probe", o->probe, "Probe to which the certificate applies")
      ->required()
      ->type_name("ID");
  command
      .add_option("--result", o->result,
                  "Name or refType of the result to read [default: all results in the certificate]")
      ->type_name("NAME");
  add_record_file_options(command, o->record);
  add_json_flag(command, o->json);
  return [o] { return take_certificate(*o); };
}

}  // namespace

Command calibrate_certificate_command() {
  return {.name = "calibrate certificate",
          .summary = "Read the sensitivity and linearity of a probe from a calibration certificate",
          .footer =
              "mdof reads a DCC (Digital Calibration Certificate of PTB) that contains a\n"
              "sensitivity (volts per length or length per volt), a table, or both. The table\n"
              "contains readings (refType basic_measuredValue) and either their errors\n"
              "(basic_measurementError) or the reference values (basic_referenceValue). mdof\n"
              "divides each expanded uncertainty U by the coverage factor and prints the values\n"
              "that it takes from the certificate. It does not verify signatures.\n"
              "Example:\n"
              "  mdof calibrate certificate K-4711.xml --rig rig_X.toml --probe A --out A.toml",
          .declare = declare_certificate};
}

}  // namespace mdof::tools
