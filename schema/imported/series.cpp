#include "schema/imported/series.h"

#include "schema/sample.h"

namespace mdof {

std::string positioning_name(Axis axis) {
  return {'E', letter(axis), letter(axis)};
}

Result<ImportedError> imported_error(Axis axis, const std::string& name) {
  if (name == positioning_name(axis)) return ImportedError{name, std::nullopt, false};
  std::string all = positioning_name(axis);
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const ErrorName& known = error_names(axis)[k];
    if (name == known.name) return ImportedError{name, k, known.angle};
    all += std::string(", ") + known.name;
  }
  return fail(ErrorCode::usage, "\"" + name + "\" is not an error of axis " + letter(axis) +
                                    "; the errors are " + all);
}

const char* to_string(PositioningSense sense) {
  return sense == PositioningSense::body ? "body" : "command";
}

std::optional<PositioningSense> positioning_sense_from(std::string_view word) {
  if (word == "command") return PositioningSense::command;
  if (word == "body") return PositioningSense::body;
  return std::nullopt;
}

ImportedError imported_run_error(const RunHeader& run) {
  return imported_error(run.axis, run.provenance.model)
      .value_or(ImportedError{run.provenance.model, std::nullopt, false});
}

double deviation(const MeasuredPoint& point) {
  return point.point.probe_m.empty() ? kNaN : point.point.probe_m.front();
}

double deviation_uncertainty(const MeasuredPoint& point) {
  return point.point.probe_u_m.empty() ? kNaN : point.point.probe_u_m.front();
}

bool is_imported(const RunHeader& run) {
  return run.provenance.recording_kind.starts_with("imported");
}

Status check_measured(const RunHeader& run, const std::string& what) {
  if (!is_imported(run)) return {};
  return bad_input("run " + std::to_string(run.id) + " was imported from " +
                   run.provenance.recording_path + " and contains only " + run.provenance.model +
                   ", but no rig; " + what + " needs a run that mdof measured or replayed");
}

}  // namespace mdof
