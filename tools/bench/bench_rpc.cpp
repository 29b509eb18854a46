// Measures the round trip of compensation.at in comparison with a simple echo server, and the
// number of pipelined requests in one second. Both servers run on the same loop, with the same kind
// of socket and the same message sizes, in alternating blocks.
//   bench_rpc [round trips] [pipelined requests]
// Exit status 1 if the ratio is above 1.5 or the rate is below 50,000 requests/s.
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "daemon/methods/methods.h"
#include "daemon/rpc/line/server.h"
#include "daemon/rpc/net/event_loop_core.h"
#include "daemon/rpc/net/socket.h"

namespace {

using namespace mdof;
using namespace mdof::rpc;
using Clock = std::chrono::steady_clock;

constexpr double kMaxRatio = 1.5;
constexpr double kMinRequestsPerS = 50e3;
constexpr int kBlock = 1000;  // number of round trips before the other server is measured

const std::string kRequest =
    R"({"jsonrpc":"2.0","method":"compensation.at","params":{"axis":"X","position_mm":12.3},"id":1})"
    "\n";

[[noreturn]] void give_up(const std::string& what) {
  std::fprintf(stderr, "bench_rpc: %s\n", what.c_str());
  std::exit(4);
}

template <class T>
T must(Result<T> result) {
  if (!result) give_up(result.error().message);
  return std::move(*result);
}

// A table with 61 points at a pitch of 1 mm, active on the X axis.
daemon::ActiveTables table_in_force() {
  store::ActiveTable active;
  active.generation = 7;
  for (int i = 0; i < 61; ++i) {
    active.table.position_m.push_back(1e-3 * i);
    for (std::size_t k = 0; k < 5; ++k) {
      const double error = 1e-6 * std::sin(0.1 * i + double(k));
      active.table.forward[k].push_back(error);
      active.table.reverse[k].push_back(error + 1e-7);
      active.table.u_forward[k].push_back(1e-8);
      active.table.u_reverse[k].push_back(1e-8);
    }
  }
  return {{std::make_shared<const store::ActiveTable>(std::move(active)), nullptr, nullptr}, {}};
}

// The echo server: sends a fixed reply for each received block.
struct Echo : std::enable_shared_from_this<Echo> {
  Echo(EventLoop& loop, int fd, std::string text)
      : socket(*loop.core()->context, fd), reply(std::move(text)) {}

  void read() {
    socket.async_read_some(asio::buffer(buffer), [self = shared_from_this()](auto error, auto) {
      if (error) return;
      (void)!::write(self->socket.native_handle(), self->reply.data(), self->reply.size());
      self->read();
    });
  }

  asio::posix::stream_descriptor socket;
  std::string reply;
  std::array<char, 65536> buffer;
};

struct Bench {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("mdof-bench-rpc-" + std::to_string(::getpid()));
  EventLoop loop;
  std::unique_ptr<daemon::Storekeeper> keeper =
      must(daemon::Storekeeper::start({folder / "mdof.db"}, {[](std::int64_t, std::int64_t) {},
                                                             [](std::int64_t, const Error&) {}}));
  store::Store reader = must(store::Store::open(folder / "mdof.db", store::Access::read_only));
  std::vector<std::unique_ptr<daemon::Station>> stations;
  daemon::ActiveTables active = table_in_force();
  daemon::QueryThread query{loop.executor(), folder / "mdof.db",
                            must(store::Store::open(folder / "mdof.db", store::Access::read_only))};
  daemon::Methods methods{loop, *keeper, reader, query, stations, active, "", "", Clock::now()};
  MethodTable table{"bench", "1"};
  Service service{loop.executor(), table};
  LineServer server{loop, service};
  Descriptor rpc, echo;
  std::string reply;
  std::thread thread;

  ~Bench() { std::filesystem::remove_all(folder); }
};

void send_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (n <= 0) give_up("the server closed the connection");
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

std::size_t receive(int fd, std::vector<char>& buffer) {
  const ssize_t n = ::recv(fd, buffer.data(), buffer.size(), 0);
  if (n <= 0) give_up("the server closed the connection");
  return static_cast<std::size_t>(n);
}

double round_trip_us(int fd, std::size_t reply_bytes, std::vector<char>& buffer) {
  const auto begin = Clock::now();
  send_all(fd, kRequest);
  for (std::size_t n = 0; n < reply_bytes;) n += receive(fd, buffer);
  return std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
}

double median(std::vector<double>& x) {
  std::nth_element(x.begin(), x.begin() + std::ptrdiff_t(x.size() / 2), x.end());
  return x[x.size() / 2];
}

void start(Bench& bench) {
  daemon::add_compensation_methods(bench.table, bench.methods);
  const std::string path = bench.folder / "socket";
  if (const auto status = bench.server.listen_unix(path); !status) give_up(status.error().message);
  bench.thread = std::thread([&bench] { bench.loop.run(); });
  auto connected = connect_to_unix(path);
  if (!connected) give_up(system_error_text(connected.error()));
  bench.rpc = std::move(*connected);
  std::vector<char> buffer(65536);
  send_all(bench.rpc.get(), kRequest);
  do bench.reply.append(buffer.data(), receive(bench.rpc.get(), buffer));
  while (!bench.reply.ends_with('\n'));
  std::array<int, 2> pair{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0)
    give_up("no socket pair");
  bench.echo = Descriptor(pair[0]);
  auto echo = std::make_shared<Echo>(bench.loop, pair[1], bench.reply);
  bench.loop.post([echo] { echo->read(); });
}

// The ratio of the median round trips.
double compare_round_trips(const Bench& bench, int count) {
  std::vector<char> buffer(65536);
  std::vector<double> rpc_us, echo_us;
  for (int i = 0; i < count; ++i) {
    const bool rpc = i / kBlock % 2 != 0;
    const int fd = rpc ? bench.rpc.get() : bench.echo.get();
    const double us = round_trip_us(fd, bench.reply.size(), buffer);
    if (i >= 2 * kBlock)
      (rpc ? rpc_us : echo_us).push_back(us);  // the first block of each server does not count
  }
  const double rpc = median(rpc_us), echo = median(echo_us);
  std::printf("round trip, median of %zu calls of each kind; request %zu bytes, reply %zu bytes\n",
              rpc_us.size(), kRequest.size(), bench.reply.size());
  std::printf("  compensation.at  %7.2f us\n  bare echo        %7.2f us\n", rpc, echo);
  std::printf("  ratio            %7.3f   (limit: %.1f)\n", rpc / echo, kMaxRatio);
  return rpc / echo;
}

double pipelined_per_s(const Bench& bench, int count) {
  // Requests in one block; blocks that are sent before the replies are read.
  constexpr int kChunk = 128, kAhead = 8;
  std::string chunk;
  for (int i = 0; i < kChunk; ++i) chunk += kRequest;
  const std::size_t chunk_reply = kChunk * bench.reply.size();
  std::vector<char> buffer(1 << 18);
  const int chunks = std::max(1, count / kChunk);
  int sent = 0;
  const auto begin = Clock::now();
  for (std::size_t got = 0; got < chunk_reply * std::size_t(chunks);) {
    for (; sent < chunks && std::size_t(sent) < got / chunk_reply + kAhead; ++sent)
      send_all(bench.rpc.get(), chunk);
    got += receive(bench.rpc.get(), buffer);
  }
  const double s = std::chrono::duration<double>(Clock::now() - begin).count();
  const double per_s = double(chunks) * kChunk / s;
  std::printf("pipelined, one connection: %.0f requests a second   (required: %.0f)\n", per_s,
              kMinRequestsPerS);
  return per_s;
}

}  // namespace

int main(int argc, char** argv) {
  const int trips = std::max(4 * kBlock, argc > 1 ? std::atoi(argv[1]) : 100 * kBlock);
  const int pipelined = argc > 2 ? std::atoi(argv[2]) : 500'000;
  Bench bench;
  start(bench);
  const double ratio = compare_round_trips(bench, trips);
  const double per_s = pipelined_per_s(bench, pipelined);
  bench.loop.stop();
  bench.thread.join();
  return ratio <= kMaxRatio && per_s >= kMinRequestsPerS ? 0 : 1;
}
