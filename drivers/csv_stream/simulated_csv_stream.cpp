#include "drivers/csv_stream/simulated_csv_stream.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "schema/base/number/number.h"
#include "schema/sample.h"

namespace mdof::drivers {
namespace {

std::string text_of(double x) {
  char text[kDouble17Size];
  return {text, write_double_17(text, x)};
}

}  // namespace

SimulatedCsvStream::SimulatedCsvStream(Senses senses, Options options)
    : senses_(std::move(senses)), options_(std::move(options)) {}

void SimulatedCsvStream::opened(std::size_t, int client, std::int64_t now_ns) {
  clients_[client] = {now_ns, now_ns, 0, false, false};
}

void SimulatedCsvStream::closed(std::size_t, int client) {
  clients_.erase(client);
}

std::string SimulatedCsvStream::header() const {
  std::string line = options_.with_time ? "time_s" : "";
  for (const auto& column : options_.columns) line += (line.empty() ? "" : ",") + column;
  return line + "\n";
}

std::string SimulatedCsvStream::row(Client& client, std::int64_t t_ns) const {
  const int number = client.next_row;
  std::string line;
  if (number == options_.faults.restart_at) {
    line = header();
    client.time_from_ns = t_ns;
  }
  const std::size_t begin = line.size();
  if (options_.with_time)
    line += text_of(static_cast<double>(t_ns - client.time_from_ns) * 1e-9 *
                    options_.faults.time_scale);
  for (std::size_t i = 0; i < options_.columns.size(); ++i)
    line += (line.size() == begin ? "" : ",") + text_of(senses_(i, t_ns));
  const bool bad =
      options_.faults.bad_line_every > 0 && (number + 1) % options_.faults.bad_line_every == 0;
  line += bad ? ",what\n" : "\n";
  client.broken = number == options_.faults.cut_row;
  return client.broken ? line.substr(0, line.size() / 2) : line;
}

std::string SimulatedCsvStream::exchange(std::size_t, int client, std::string_view,
                                         std::int64_t now_ns) {
  Client& c = clients_.at(client);
  std::string text;
  if (!std::exchange(c.greeted, true) && !options_.faults.no_header) text = header();
  for (; !c.broken && c.next_row != options_.faults.silent_from; ++c.next_row) {
    const std::int64_t t_ns = c.opened_ns + std::llround(c.next_row * 1e9 / options_.rate_hz);
    if (t_ns > now_ns) break;
    text += row(c, t_ns);
  }
  return text;
}

bool SimulatedCsvStream::hangs_up(std::size_t, int client) {
  const auto found = clients_.find(client);
  return found != clients_.end() && found->second.broken;
}

Result<std::unique_ptr<SimulatedDevice>> make_simulated_csv_stream(SimulatedWiring& wiring) {
  SimulatedCsvStream::Options options;
  std::vector<SensedInput> sensed;
  for (const std::string& input : wiring.inputs()) {
    const bool encoder = input == kEncoderChannel;
    options.columns.push_back(input + (encoder ? "_mm" : "_um"));
    sensed.push_back({input, encoder ? 1e-3 : 1, 0});
  }
  options.rate_hz = wiring.table().number("rate_hz", options.rate_hz);
  if (!(options.rate_hz > 0 && options.rate_hz <= 1e5))
    wiring.table().reject("rate_hz", "must be more than 0 and at most 100000");
  options.with_time = wiring.table().boolean("with_time", options.with_time);
  return std::make_unique<SimulatedCsvStream>(wiring.senses(std::move(sensed)), std::move(options));
}

}  // namespace mdof::drivers
