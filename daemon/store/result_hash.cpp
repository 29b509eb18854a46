#include "daemon/store/result_hash.h"

#include <cstdint>
#include <span>
#include <string_view>

#include "schema/base/canonical.h"

namespace mdof::store {
namespace {

using canonical::put;
using canonical::put_counted;

void put(std::string& row, const AxisErrors& errors) {
  put(row, errors.valid ? 1 : 0);
  if (!errors.valid) return put(row, std::string_view(errors.reason));
  put(row, std::span<const double>(errors.local));
  put(row, errors.residual_m);
  put(row, std::span<const double>(errors.covariance));
}

void put(std::string& row, const Point& point) {
  put(row, point.direction);
  put(row, point.begin_ns);
  put(row, point.end_ns);
  put(row, point.position_m);
  put(row, point.samples);
  put(row, static_cast<std::uint64_t>(point.flags.size()));
  for (const PointFlag& flag : point.flags) put(row, std::string_view(to_string(flag)));
  put_counted(row, point.probe_m);
  put_counted(row, point.probe_u_m);
}

}  // namespace

void ResultHash::add(const MeasuredPoint& point) {
  row_.clear();
  put(row_, point.target);
  put(row_, point.target_m);
  put(row_, point.run);
  put(row_, point.point);
  put(row_, point.errors);
  hash_.update(row_);
}

void ResultHash::add(const StraightnessFigure& figure) {
  row_.clear();
  put(row_, std::string_view(figure.error_key));
  put(row_, std::string_view(figure.approach));
  for (const double x :
       {figure.slope_least_squares_rad, figure.slope_end_point_rad, figure.form_rad,
        figure.straightness_least_squares_m, figure.straightness_end_point_m,
        figure.peak_position_m, figure.valley_position_m})
    put(row_, x);
  hash_.update(row_);
}

void ResultHash::add(const AngleFigure& figure) {
  row_.clear();
  put(row_, std::string_view(figure.error_key));
  put(row_, std::string_view(figure.approach));
  for (const double x : {figure.start_rad, figure.min_rad, figure.max_rad}) put(row_, x);
  hash_.update(row_);
}

std::string ResultHash::hex() const {
  return hash_.hex();
}

std::uint64_t row_hash(const MeasuredPoint& point) {
  ResultHash hash;
  hash.add(point);
  return std::stoull(hash.hex().substr(0, 16), nullptr, 16);
}

std::string result_sha256(const Run& run) {
  ResultHash hash;
  for (const MeasuredPoint& point : run.points) hash.add(point);
  for (const StraightnessFigure& figure : run.straightness) hash.add(figure);
  for (const AngleFigure& figure : run.angles) hash.add(figure);
  return hash.hex();
}

}  // namespace mdof::store
