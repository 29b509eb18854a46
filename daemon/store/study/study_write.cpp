// Functions of Store that write studies.
#include "daemon/store/store.h"
#include "schema/base/sha256.h"

namespace mdof::store {

using sqlite::Statement;
using sqlite::Transaction;

namespace {

std::int64_t integer(std::uint64_t x) {
  return static_cast<std::int64_t>(x);
}

}  // namespace

Result<std::int64_t> Store::begin_study(const StudyRecord& study) {
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_TRY(const std::int64_t plan, document_id(study.plan_toml));
  MDOF_TRY(const std::int64_t settings, document_id(study.settings_toml));
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO study (name, plan, source, settings, seed, "
                               "trials_wanted, fingerprint, started_utc, software_version) "
                               "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  insert.bind(std::string_view(study.name)).bind(plan).bind(std::string_view(study.source));
  insert.bind(settings).bind(study.seed).bind(study.trials_wanted);
  insert.bind(std::string_view(study.fingerprint)).bind(std::string_view(study.started_utc));
  insert.bind(std::string_view(study.software_version));
  MDOF_CHECK(insert.run());
  const std::int64_t id = connection_.last_insert_rowid();
  MDOF_CHECK(transaction.commit());
  return id;
}

Status Store::replace_checkpoint(std::int64_t study, const StudyCheckpoint& checkpoint) {
  MDOF_TRY(Statement insert, connection_.prepare("INSERT OR REPLACE INTO study_checkpoint "
                                                 "(study, trials, sha256, bytes) "
                                                 "VALUES (?, ?, ?, ?)"));
  const std::string sha256 = sha256_hex(checkpoint.bytes);
  insert.bind(study).bind(integer(checkpoint.trials)).bind(std::string_view(sha256));
  return insert.bind_bytes(checkpoint.bytes).run();
}

Status Store::insert_outcome(std::int64_t study, const StudyOutcome& outcome) {
  MDOF_TRY(Statement insert,
           connection_.prepare("INSERT INTO study_result (study, state, trials, elapsed_s, "
                               "ended_utc, software_version, figures, figures_sha256) "
                               "VALUES (?, ?, ?, ?, ?, ?, ?, ?)"));
  const std::string sha256 = sha256_hex(outcome.figures_json);
  insert.bind(study).bind(std::string_view(to_string(outcome.state)));
  insert.bind(integer(outcome.trials)).bind(outcome.elapsed_s);
  insert.bind(std::string_view(outcome.ended_utc));
  insert.bind(std::string_view(outcome.software_version));
  insert.bind(std::string_view(outcome.figures_json)).bind(std::string_view(sha256));
  return insert.run();
}

Status Store::save_checkpoint(std::int64_t study, const StudyCheckpoint& checkpoint) {
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_CHECK(check_exists(RowOf::study, study));
  MDOF_CHECK(replace_checkpoint(study, checkpoint));
  return transaction.commit();
}

Status Store::end_study(std::int64_t study, const StudyOutcome& outcome,
                        const std::optional<StudyCheckpoint>& checkpoint) {
  MDOF_TRY(Transaction transaction, Transaction::begin(connection_));
  MDOF_CHECK(check_exists(RowOf::study, study));
  MDOF_CHECK(insert_outcome(study, outcome));
  if (checkpoint) {
    MDOF_CHECK(replace_checkpoint(study, *checkpoint));
  } else {
    MDOF_TRY(Statement remove, connection_.prepare("DELETE FROM study_checkpoint WHERE study = ?"));
    MDOF_CHECK(remove.bind(study).run());
  }
  return transaction.commit();
}

}  // namespace mdof::store
