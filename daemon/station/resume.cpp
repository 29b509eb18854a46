#include "daemon/station/resume.h"

#include <algorithm>

#include "daemon/measure/replay/request_json.h"
#include "daemon/words/error_text.h"
#include "drivers/recording/recording_log.h"

namespace mdof::daemon {
namespace {

constexpr std::chrono::milliseconds kLogTimeout{1000};
// Shortest pause between the recorded times of the two parts of the run. The pause is longer than
// the differences between the times of the devices of an axis.
constexpr std::int64_t kPause_ns = 5'000'000'000;
constexpr int kBlocksPerCommit = 64;

tl::unexpected<Error> refused(std::int64_t run, const std::string& why,
                              Remedy remedy = Remedy::none) {
  return fail(ErrorCode::conflict, "run " + std::to_string(run) + " cannot be continued: " + why,
              remedy);
}

Status check_can_go_on(store::Store& reader, const RunHeader& run, const AxisConfig& axis) {
  if (run.state == RunState::open) return refused(run.id, "this run is under way");
  if (run.state == RunState::complete) return refused(run.id, "this run is complete");
  if (run.provenance.recording_kind != "recording")
    return refused(
        run.id, "the readings of this run come from a file (a log or an import), not from devices");
  MDOF_TRY(const auto later, reader.superseded_by(run.id));
  if (later) return refused(run.id, "run " + std::to_string(*later) + " supersedes this run");
  if (run.provenance.rig_text != axis.rig.text)
    return refused(run.id, "the rig was changed after this run began; start a new run");
  if (run.simulated != axis.simulated())
    return refused(run.id, run.simulated ? "at least one device of the run was simulated, but now "
                                           "no device of the axis is simulated; start a new run"
                                         : "no device of the run was simulated, but now a device "
                                           "of the axis is simulated; start a new run");
  return {};
}

// Whether the new run keeps this notice of the old run. A notice is kept if the new run cannot
// calculate the notice again from the samples.
bool stays(const Notice& of_run) {
  using enum NoticeCode;
  const std::initializer_list<NoticeCode> kept = {run_goes_on,         device_trouble,
                                                  trouble_at_start,    clock_not_settled,
                                                  scale_period_hidden, blocks_not_recorded};
  return std::find(kept.begin(), kept.end(), of_run.code) != kept.end() ||
         of_run.source.starts_with("device ");
}

// The notices that were known when the run began. If mdofd was killed during the run, only the
// recording contains them. record_again() reports a recording that cannot be read.
Notices requested_notices(const std::string& recording) {
  drivers::RecordingLog log("recording", recording);
  if (!log.open()) return {};
  const auto asked = read_request_json(log.header().request, {});
  return asked ? asked->notices : Notices();
}

Result<std::int64_t> copy(drivers::RecordingLog& log, store::RecordingWriter& writer,
                          Pipeline& pipeline, const std::atomic<bool>& wanted) {
  std::int64_t end_ns = std::numeric_limits<std::int64_t>::min();
  SampleBlock block;
  for (int blocks = 1; wanted; ++blocks) {
    MDOF_TRY(const auto state, log.read(block, kLogTimeout));
    if (block.scans() > 0) {
      end_ns = std::max(end_ns, block.time_ns.back());
      MDOF_CHECK(writer.append(block));
      MDOF_CHECK(pipeline.push(block));
    }
    const bool end = state == drivers::ReadState::end;
    if (end || blocks % kBlocksPerCommit == 0) MDOF_CHECK(writer.commit());
    if (end) return end_ns;
  }
  return io_error("mdofd is stopping");
}

}  // namespace

Result<RunRequest> request_to_resume(store::Store& reader, std::int64_t run,
                                     const AxisConfig& axis) {
  MDOF_TRY(const RunHeader header, reader.run_header(run));
  MDOF_CHECK(check_can_go_on(reader, header, axis));
  const auto options = read_options_json(header.provenance.options_json, {});
  if (!options)
    return refused(run,
                   "the stored request of the run is invalid: " + words::text(options.error()));
  RunRequest request;
  request.note = header.note;
  request.targets_m = options->sequence.targets_m;
  request.repeats = options->repeats;
  request.resumes =
      CutOffRun{run, header.provenance.recording_path, options->datum, options->settings_json()};
  Notices of_run = header.notices;
  append(of_run, requested_notices(header.provenance.recording_path));
  for (const Notice& one : of_run) {
    auto& kept = request.notices;
    if (stays(one) && std::find(kept.begin(), kept.end(), one) == kept.end()) kept.push_back(one);
  }
  request.notices.push_back(
      notice(NoticeCode::run_goes_on, "", {{"run", run}, {"datum", datum_text(options->datum)}}));
  return request;
}

Status check_same_settings(const CutOffRun& cut_off, const PipelineOptions& now) {
  if (cut_off.settings == now.settings_json()) return {};
  return refused(cut_off.id,
                 "the model, the delays or other settings of the measurement have changed in the "
                 "configuration since this run; restore the old settings and restart mdofd, or "
                 "start a new run");
}

Status check_same_datum(const CutOffRun& cut_off, const EncoderDatum& now, bool counts_on) {
  using Kind = EncoderDatum::Kind;
  const EncoderDatum& of_run = cut_off.datum;
  const bool alike = of_run.kind == now.kind && of_run.offset_m == now.offset_m;
  if (of_run.kind == Kind::index || now.kind == Kind::index) {
    if (alike) return {};
    if (now.kind != Kind::index)
      return refused(
          cut_off.id,
          "the positions of this run were counted from the reference mark of the encoder, but the "
          "present positions of the axis are not counted from this mark",
          Remedy::pass_reference_mark_or_start);
    return refused(cut_off.id,
                   "the axis passed its reference mark after the run ended, so the zero of the "
                   "present positions is not the zero of the run; start a new run");
  }
  const bool in_machine = of_run.kind == Kind::set || of_run.kind == Kind::configured;
  // The positions of both parts are machine positions.
  if (in_machine && now.kind == Kind::set) return {};
  if (alike && counts_on) return {};
  if (of_run.kind == Kind::none)
    return refused(cut_off.id,
                   "the encoder had no datum in this run and may have stopped counting after the "
                   "run, so the present positions may differ from the positions of the run",
                   Remedy::set_encoder_then_start);
  if (of_run.kind == Kind::absolute && now.kind != Kind::none)
    return refused(cut_off.id,
                   "the positions of this run are the readings of the device without an offset, "
                   "but the present positions of the axis contain an offset; start a new run");
  return refused(cut_off.id,
                 "the positions of this run are machine positions (" + datum_text(of_run) +
                     "), but the encoder has lost its datum since the run",
                 Remedy::set_encoder_then_resume);
}

Result<std::int64_t> record_again(const CutOffRun& cut_off, const Storekeeper& keeper, NewRun& run,
                                  Pipeline& pipeline, const std::atomic<bool>& wanted) {
  drivers::RecordingLog log("recording", cut_off.recording);
  MDOF_CHECK(log.open());
  MDOF_TRY(auto writer, keeper.create_recording(run));
  run.begun.emplace(std::move(writer));
  auto end_ns = copy(log, *run.begun, pipeline, wanted);
  if (!end_ns) {
    run.begun.reset();
    store::RecordingWriter::remove(run.recording);
  }
  return end_ns;
}

void Continuation::shift(SampleBlock& block) {
  // after_ns_ is the smallest number if the old run has no samples, so it must not be decreased.
  const std::int64_t begin_ns = block.time_ns.front();
  if (!shift_ns_) shift_ns_ = std::max(after_ns_ + kPause_ns, begin_ns) - begin_ns;
  for (std::int64_t& time_ns : block.time_ns) time_ns += *shift_ns_;
  if (seen_.insert(block.device).second) block.lost = std::max<std::uint64_t>(1, block.lost);
}

}  // namespace mdof::daemon
