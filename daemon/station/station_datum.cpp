// Functions of Station that set the axis position. The measure thread calculates the setting. The
// setting becomes valid when the store has stored it; until then no run can begin. This file also
// contains the functions for the reference mark of an encoder.
#include "daemon/history.h"
#include "daemon/paths.h"
#include "daemon/station/open_run.h"
#include "daemon/station/station.h"

namespace mdof::daemon {

// ---- functions on the main thread ----

void Station::set_encoder(double position_m, const HistoryEntry& action, DatumDone done) {
  const std::string axis(1, letter(config_.rig.axis));
  if (!config_.live())
    return done(fail(ErrorCode::conflict,
                     "axis " + axis + " is read from a log, so its position cannot be set"));
  std::int64_t none = 0;
  if (!shared_->run.compare_exchange_strong(none, -1))
    return done(fail(ErrorCode::conflict, occupied_reason(none)));
  shared_->post([position_m, action, done = std::move(done)](Station& s) {
    s.take_datum(position_m, action, done);
  });
}

// ---- functions on the measure thread; set_encoder() has checked that no run is in progress ----

void Station::take_datum(double position_m, const HistoryEntry& action, const DatumDone& done) {
  const auto found = zero_.find(config_.rig.axis, position_m, action.utc);
  if (found) return store_datum(*found, action, done);
  shared_->run = 0;
  done(tl::unexpected(found.error()));
}

void Station::store_datum(const DatumSetting& setting, const HistoryEntry& action,
                          const DatumDone& done) {
  const auto put = [=, shared = shared_](const Result<DatumSetting>& stored) {
    shared->post([=](Station& s) { s.put_datum(stored, action, done); });
  };
  if (const std::string fault = keeper_.fault(); !fault.empty()) return put(io_error(fault));
  const bool posted = keeper_.post([put, setting, action](store::Store& store) {
    const auto id = store.add_datum(setting, action);
    put(id ? Result<DatumSetting>(setting) : tl::unexpected(id.error()));
  });
  if (!posted) put(io_error("too many writes to the database are pending; try again"));
}

// The live view starts again. Otherwise the change of the position would look like a motion of the
// axis.
void Station::put_datum(const Result<DatumSetting>& stored, const HistoryEntry& action,
                        const DatumDone& done) {
  const auto set = stored ? zero_.put(*stored, actor_text(action.by))
                          : Result<EncoderDatum>(tl::unexpected(stored.error()));
  if (set) {
    view_.reset();
    for (auto& acquisition : acquisitions_)
      if (acquisition->spec().name == set->device) acquisition->trust_count();
  }
  shared_->run = 0;
  done(set);
}

// The live view starts again, as in put_datum(). A run cannot continue, because its positions have
// another origin. The difference of the two origins is not known well enough: its uncertainty is as
// large as the distance between two readings.
void Station::take_mark(const std::string& device) {
  if (!zero_.pass_mark(device, utc_now())) return;
  view_.reset();
  if (open_) end_unless_from_mark();
}

// Ends the run, unless its positions are counted from the mark, too. Such a run continues, for
// example after the device lost power.
void Station::end_unless_from_mark() {
  if (zero_.datum().kind != EncoderDatum::Kind::index ||
      open_->datum.kind == EncoderDatum::Kind::index)
    return;
  finish(RunState::aborted, {notice(NoticeCode::reference_mark_passed)});
}

}  // namespace mdof::daemon
