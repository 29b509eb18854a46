#include "daemon/measure/replay/verify_sources.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <utility>

#include "daemon/words/error_text.h"
#include "drivers/recording/recording_log.h"
#include "schema/base/database/files.h"
#include "schema/base/sha256.h"

namespace mdof::daemon {
namespace {

constexpr std::int64_t kPage = 500;

// Path and stored hash of a file. Each file has a list of the runs that were calculated from it.
using Source = std::pair<std::string, std::string>;  // path, sha256
using Sources = std::map<Source, std::vector<std::int64_t>>;

std::string runs_text(const std::vector<std::int64_t>& runs) {
  constexpr std::size_t kNamed = 8;
  std::string text = runs.size() == 1 ? "run " : "runs ";
  for (std::size_t i = 0; i < std::min(runs.size(), kNamed); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(runs[i]);
  return runs.size() <= kNamed ? text
                               : text + " and " + std::to_string(runs.size() - kNamed) + " more";
}

// Error: the file cannot be read.
Result<std::string> sha256_of_file(const std::string& path) {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  const int file = sqlite::open_foreign(path, 0);
  if (file < 0) return io_error(path + ": cannot be read: " + sqlite::foreign_error_text(errno));
  std::string piece(kPiece, '\0');
  Sha256 hash;
  ssize_t count = 0;
  do {
    count = ::read(file, piece.data(), piece.size());
    if (count > 0) hash.update({piece.data(), static_cast<std::size_t>(count)});
  } while (count > 0 || (count < 0 && errno == EINTR));
  const int error = errno;
  ::close(file);
  if (count == 0) return hash.hex();
  return io_error(path + ": cannot be read: " + std::strerror(error));
}

// Error: the recording cannot be read or is damaged.
Result<std::string> recording_hash(const std::string& path) {
  drivers::RecordingLog log("recording", path);
  MDOF_CHECK(log.open());
  SampleBlock block;
  for (;;) {
    MDOF_TRY(const auto state, log.read(block, {}));
    if (state == drivers::ReadState::end) return log.sha256();
  }
}

void check_file(const Source& source, const std::string& of, SourceCheck& check) {
  const auto& [path, expected] = source;
  std::error_code ec;
  if (!std::filesystem::exists(path, ec)) {
    check.findings.push_back(
        of + ": the file " + path + " is missing" +
        (expected.empty() ? std::string() : " (its sha256 was " + expected + ")") +
        "; restore the file, or create a link with this name, so that the run can be replayed");
    return;
  }
  const bool recording = drivers::is_recording(path);
  if (expected.empty() && !recording) {
    check.notices.push_back(
        inherited(of, notice(NoticeCode::source_not_hashed, "", {{"path", path}})));
    return;
  }
  const auto actual = recording ? recording_hash(path) : sha256_of_file(path);
  if (!actual) {
    check.findings.push_back(of + ": " + words::text(actual.error()));
  } else if (!expected.empty() && *actual != expected) {
    check.findings.push_back(of + ": the file " + path +
                             " is not the file from which the run was calculated (its sha256 is " +
                             *actual + ", expected " + expected +
                             "); restore the original file from a copy");
  }
}

void add_source(const RunHeader& run, Sources& sources, SourceCheck& check) {
  const Provenance& from = run.provenance;
  const auto cannot_check = [&](NoticeCode why) {
    check.notices.push_back(inherited("run " + std::to_string(run.id), notice(why)));
  };
  if (run.state == RunState::open) {
    cannot_check(NoticeCode::source_run_open);
  } else if (from.recording_path == "-") {
    cannot_check(NoticeCode::source_standard_input);
  } else if (from.recording_path.empty()) {
    cannot_check(NoticeCode::source_not_stored);
  } else {
    sources[{from.recording_path, from.recording_sha256}].push_back(run.id);
  }
}

}  // namespace

Result<SourceCheck> verify_sources(store::Store& store) {
  SourceCheck check;
  Sources sources;
  for (std::int64_t offset = 0;; offset += kPage) {
    MDOF_TRY(const auto page, store.list_runs(offset, kPage));
    for (const RunHeader& run : page) add_source(run, sources, check);
    if (static_cast<std::int64_t>(page.size()) < kPage) break;
  }
  for (auto& [source, runs] : sources) {
    std::sort(runs.begin(), runs.end());
    check_file(source, runs_text(runs), check);
  }
  return check;
}

}  // namespace mdof::daemon
