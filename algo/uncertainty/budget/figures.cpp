#include "algo/uncertainty/budget/figures.h"

#include <algorithm>
#include <utility>

#include "algo/iso230/line_fit.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

struct Series {
  Series(const MeanErrors& means, std::size_t named)
      : travel_m(own_travels(means.sides, means.targets)), error(column(means.targets, named)) {}
  bool has_line() const { return travel_m.size() >= 3 && can_fit(travel_m); }
  Line line() const { return least_squares_line(travel_m, error); }

  std::vector<double> travel_m, error;
};

std::string name_of(Axis axis, std::size_t named, const char* figure) {
  const ErrorName& name = error_names(axis)[named];
  const bool in_urad = name.angle || std::string_view(figure) == "_slope";
  return std::string(name.name) + figure + (in_urad ? "_urad" : "_um");
}

Figure range_of(std::string name,
                std::function<std::vector<double>(const MeanErrors&)> deviations) {
  auto of = [deviations](const MeanErrors& means) {
    const std::vector<double> all = deviations(means);
    if (all.empty()) return kNaN;
    const auto [least, most] = std::minmax_element(all.begin(), all.end());
    return *most - *least;
  };
  return {std::move(name), std::move(of), std::move(deviations)};
}

}  // namespace

Figure straightness_figure(Axis axis, std::size_t named) {
  return range_of(name_of(axis, named, "_straightness"), [named](const MeanErrors& means) {
    const Series series(means, named);
    if (!series.has_line()) return std::vector<double>();
    const Line line = series.line();
    std::vector<double> off = series.error;
    for (std::size_t i = 0; i < off.size(); ++i) off[i] -= line.at(series.travel_m[i]);
    return off;
  });
}

Figure slope_figure(Axis axis, std::size_t named) {
  return {name_of(axis, named, "_slope"), [named](const MeanErrors& means) {
            const Series series(means, named);
            return series.has_line() ? series.line().slope : kNaN;
          }};
}

Figure range_figure(Axis axis, std::size_t named) {
  return range_of(name_of(axis, named, "_range"), [named](const MeanErrors& means) {
    const auto values = column(means.targets, named);
    return values.size() < 2 ? std::vector<double>() : values;
  });
}

Figure error_figure(Axis axis, std::size_t named, int target) {
  return {name_of(axis, named, ""), [named, target](const MeanErrors& means) {
            for (const TargetMean& mean : means.targets)
              if (mean.target == target) return mean.named[named];
            return kNaN;
          }};
}

std::vector<Figure> figures_of_run(Axis axis) {
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    if (error_names(axis)[k].angle) {
      figures.push_back(range_figure(axis, k));
    } else {
      figures.push_back(straightness_figure(axis, k));
      figures.push_back(slope_figure(axis, k));
    }
  }
  return figures;
}

std::vector<Figure> errors_at_target(Axis axis, int target) {
  std::vector<Figure> figures;
  for (std::size_t k = 0; k < kErrorCount; ++k) figures.push_back(error_figure(axis, k, target));
  return figures;
}

}  // namespace mdof::algo
