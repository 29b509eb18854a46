#include "drivers/csv_stream/device.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "schema/base/number/number.h"

namespace mdof::drivers {
namespace {

std::string text_of(double x) {
  char text[kDouble17Size];
  return {text, write_double_17(text, x)};
}

}  // namespace

CsvStreamDevice::CsvStreamDevice(std::vector<std::string> columns, double rate_hz, bool with_time,
                                 Senses senses, Faults faults)
    : columns_(std::move(columns)),
      rate_hz_(rate_hz),
      with_time_(with_time),
      senses_(std::move(senses)),
      faults_(faults) {}

void CsvStreamDevice::opened(std::size_t, int client, std::int64_t now_ns) {
  clients_[client] = {now_ns, now_ns, 0, false, false};
}

void CsvStreamDevice::closed(std::size_t, int client) {
  clients_.erase(client);
}

std::string CsvStreamDevice::header() const {
  std::string line = with_time_ ? "time_s" : "";
  for (const auto& column : columns_) line += (line.empty() ? "" : ",") + column;
  return line + "\n";
}

std::string CsvStreamDevice::row(Client& client, std::int64_t t_ns) const {
  const int number = client.next_row;
  std::string line;
  if (number == faults_.restart_at) {
    line = header();
    client.time_from_ns = t_ns;
  }
  const std::size_t begin = line.size();
  if (with_time_)
    line += text_of(static_cast<double>(t_ns - client.time_from_ns) * 1e-9 * faults_.time_scale);
  for (std::size_t i = 0; i < columns_.size(); ++i)
    line += (line.size() == begin ? "" : ",") + text_of(senses_(i, t_ns));
  const bool bad = faults_.bad_line_every > 0 && (number + 1) % faults_.bad_line_every == 0;
  line += bad ? ",what\n" : "\n";
  client.broken = number == faults_.cut_row;
  return client.broken ? line.substr(0, line.size() / 2) : line;
}

std::string CsvStreamDevice::exchange(std::size_t, int client, std::string_view,
                                      std::int64_t now_ns) {
  Client& c = clients_.at(client);
  std::string text;
  if (!std::exchange(c.greeted, true) && !faults_.no_header) text = header();
  for (; !c.broken && c.next_row != faults_.silent_from; ++c.next_row) {
    const std::int64_t t_ns = c.opened_ns + std::llround(c.next_row * 1e9 / rate_hz_);
    if (t_ns > now_ns) break;
    text += row(c, t_ns);
  }
  return text;
}

bool CsvStreamDevice::hangs_up(std::size_t, int client) {
  const auto found = clients_.find(client);
  return found != clients_.end() && found->second.broken;
}

}  // namespace mdof::drivers
