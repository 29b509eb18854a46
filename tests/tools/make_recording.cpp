// Converts a probe log to a recording, for tests.
// Usage: make_recording LOG.csv RIG.toml OUT.mdofrec [STARTED_UTC]
#include <cstdio>

#include "daemon/store/recording_writer.h"
#include "drivers/csv/csv_log.h"
#include "schema/base/files.h"

namespace {

using namespace mdof;

Status convert(const char* log_file, const char* rig_file, const char* out,
               const char* started_utc) {
  RecordingHeader header;
  MDOF_TRY(header.rig_text, read_text_file(rig_file));
  header.software_version = "test";
  header.devices = "[]";
  header.started_utc = started_utc;
  MDOF_TRY(auto writer, store::RecordingWriter::create(out, header));
  drivers::CsvLog log(log_file);
  MDOF_CHECK(log.open());
  SampleBlock block;
  for (;;) {
    MDOF_TRY(const auto state, log.read(block, std::chrono::milliseconds(1000)));
    if (state == drivers::ReadState::end) break;
    if (block.scans() > 0) MDOF_CHECK(writer.append(block));
  }
  MDOF_CHECK(writer.commit());
  MDOF_TRY(const std::string sha256, writer.finish("2026-01-02T03:14:05.678Z"));
  std::puts(sha256.c_str());
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) return 2;
  const char* started_utc = argc == 5 ? argv[4] : "2026-01-02T03:04:05.678Z";
  const Status done = convert(argv[1], argv[2], argv[3], started_utc);
  if (!done) std::fprintf(stderr, "%s\n", done.error().message.c_str());
  return done ? 0 : 1;
}
