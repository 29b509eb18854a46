#include "drivers/labjack/count_guard.h"

#include "schema/base/number/number_text.h"

namespace mdof::drivers::labjack {

double read_most_counts_per_s(TomlTable& channel) {
  if (!channel.has("most_counts_per_s")) return 0;
  const double most = channel.number("most_counts_per_s", 0);
  if (!(most > 0 && std::isfinite(most)))
    channel.reject("most_counts_per_s", "must be more than 0");
  return most;
}

std::string speed_text(double most_counts_per_s, double um_per_count) {
  if (most_counts_per_s <= 0) return "";
  return "counts up to " + plain_number(most_counts_per_s * std::abs(um_per_count) * 1e-3) +
         " mm/s";
}

}  // namespace mdof::drivers::labjack
