#include "tools/mdof/study/running/recorder.h"

#include <filesystem>

#include "daemon/paths.h"
#include "daemon/version.h"
#include "daemon/words/error_text.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/database.h"

namespace mdof::tools {
namespace {

Result<store::StudyRecord> record_of(const Study& study, const std::string& started_utc) {
  const StudySettings& settings = study.request.settings;
  store::StudyRecord record;
  record.name = study.name;
  record.plan_toml = study.request.plan_toml;
  // The path is absolute, so that the study can be continued from any folder.
  if (!study.request.source.empty())
    record.source = std::filesystem::absolute(study.request.source).lexically_normal();
  record.settings_toml = settings_toml(settings);
  record.seed = static_cast<std::int64_t>(*settings.seed);
  if (settings.trials && !settings.adaptive)
    record.trials_wanted = static_cast<std::int64_t>(*settings.trials);
  MDOF_TRY(record.fingerprint, fingerprint(study));
  record.started_utc = started_utc;
  record.software_version = daemon::kVersion;
  return record;
}

store::StudyCheckpoint checkpoint_of(const StudyWork& state) {
  return {state.trials, checkpoint_bytes(state)};
}

}  // namespace

Result<StoredStudy> study_to_continue(const std::string& database, std::int64_t id) {
  MDOF_TRY(store::Store store, open_to_read(database));
  StoredStudy stored;
  MDOF_TRY(stored.record, store.study(id));
  MDOF_TRY(auto checkpoint, store.study_checkpoint(id));
  if (!checkpoint) {
    MDOF_TRY(const auto outcome, store.study_outcome(id));
    return fail(
        ErrorCode::conflict,
        "study " + std::to_string(id) +
            (outcome ? ": the study is complete; see mdof studies " + std::to_string(id)
                     : ": the study ended before the first checkpoint; run the study again"));
  }
  stored.checkpoint = std::move(*checkpoint);
  MDOF_TRY(const StudySettings settings, parse_settings(stored.record.settings_toml));
  stored.request = {stored.record.plan_toml, stored.record.source, settings};
  return stored;
}

Result<StudyWork> continued_work(const StoredStudy& stored, const Study& study) {
  const std::string place = "study " + std::to_string(stored.record.id);
  MDOF_TRY(const std::string now, fingerprint(study));
  const std::string changed = changed_since(stored.record.fingerprint, now);
  if (changed == kFirstTrials)
    return bad_input(place +
                     ": the first trials give other results than before, because mdof has changed "
                     "(the study was started with " +
                     stored.record.software_version + "); run the study again");
  if (!changed.empty())
    return bad_input(
        place + ": " + changed +
        " has changed after the start of the study; restore this file, or run the study again");
  auto state = parse_checkpoint(stored.checkpoint.bytes, *study.experiment);
  if (!state) return in_context(place, state.error());
  return state;
}

Result<StudyRecorder> StudyRecorder::begin(std::string database, const Study& study,
                                           const std::string& started_utc) {
  MDOF_TRY(store::Store store, open_to_write(database));
  MDOF_TRY(const store::StudyRecord record, record_of(study, started_utc));
  MDOF_TRY(const std::int64_t id, store.begin_study(record));
  return StudyRecorder(std::move(database), id);
}

void StudyRecorder::checkpoint(const StudyWork& state) const {
  if (!id_) return;
  auto store = open_to_write(database_);
  const Status kept =
      store ? store->save_checkpoint(*id_, checkpoint_of(state)) : tl::unexpected(store.error());
  if (!kept) warn("the checkpoint was not stored: " + words::text(kept.error()));
}

Status StudyRecorder::end(const StudyResult& result, const std::string& figures_json,
                          const StudyWork& state) const {
  if (!id_) return {};
  MDOF_TRY(store::Store store, open_to_write(database_));
  std::optional<store::StudyCheckpoint> checkpoint;
  if (result.state != StudyState::complete) checkpoint = checkpoint_of(state);
  return store.end_study(*id_,
                         {result.state, result.trials, result.elapsed_s, daemon::utc_now(),
                          daemon::kVersion, figures_json},
                         checkpoint);
}

std::string StudyRecorder::continue_command() const {
  return "mdof sensitivity --continue " + std::to_string(*id_) + place_options(database_);
}

}  // namespace mdof::tools
