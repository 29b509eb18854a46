#include "daemon/output/charts/run/points.h"

#include "schema/axis.h"
#include "schema/units.h"

namespace mdof::charts {

using output::Phrase;
using output::phrase;

std::vector<Mark> error_marks(const StatedResults& results, std::size_t named) {
  const Run& run = results.run;
  std::vector<Mark> marks;
  marks.reserve(run.points.size());
  for (std::size_t row = 0; row < run.points.size(); ++row) {
    const MeasuredPoint& p = run.points[row];
    Mark mark;
    mark.x = to_mm(p.point.position_m);
    mark.y = p.errors.valid
                 ? to_key_unit(named_from_local(run.header.moving(), p.errors.local)[named])
                 : std::nan("");
    if (p.errors.valid) mark.U = to_key_unit(results.uncertainty.points[row].U[named]);
    mark.direction = p.point.direction;
    mark.target = p.target;
    mark.row = row;
    mark.flags = to_string(p.point.flags);
    if (!p.errors.valid) mark.reason = p.errors.reason;
    marks.push_back(std::move(mark));
  }
  return marks;
}

Legend marks_legend(std::span<const Mark> marks) {
  Legend legend;
  for (const Mark& mark : marks) {
    const bool known = std::isfinite(mark.y);
    legend.unsolved |= !known;
    legend.forward |= known && mark.direction > 0;
    legend.reverse |= known && mark.direction < 0;
    legend.unknown |= known && mark.direction == 0;
    legend.flagged |= known && !mark.flags.empty();
    legend.band |= known && std::isfinite(mark.U);
  }
  return legend;
}

std::string run_title(const RunHeader& header, const std::string& what, Language language) {
  return phrase(Phrase::run_axis, language,
                {std::to_string(header.id), std::string(1, letter(header.axis))}) +
         ": " + what;
}

std::string about_run(const RunHeader& header, Language language) {
  const std::string& sha256 = header.provenance.recording_sha256;
  return phrase(Phrase::model_state, language,
                {header.provenance.model, output::state_text(header.state, language)}) +
         (sha256.empty() ? "" : ", " + phrase(Phrase::recording, language, {sha256.substr(0, 16)}));
}

std::vector<std::string> with_noise_only_mark(NoiseOnly noise_only, std::vector<std::string> marks,
                                              Language language) {
  if (noise_only == NoiseOnly::none) return marks;
  marks.insert(marks.begin(), phrase(noise_only == NoiseOnly::all ? Phrase::noise_only
                                                                  : Phrase::noise_only_in_part,
                                     language));
  return marks;
}

std::vector<std::string> with_noise_only_mark(bool noise_only, std::vector<std::string> marks,
                                              Language language) {
  return with_noise_only_mark(noise_only_if(noise_only), std::move(marks), language);
}

std::string position_key(Language language) {
  return std::string(phrase(Phrase::position, language)) + "_mm";
}

}  // namespace mdof::charts
