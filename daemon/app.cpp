#include "daemon/app.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <optional>

#include "daemon/methods/methods.h"
#include "daemon/paths.h"
#include "daemon/rpc/line/server.h"
#include "daemon/rpc/web/http_server.h"
#include "daemon/rpc/web/token.h"
#include "daemon/station/check_start.h"
#include "daemon/station/clock_watch.h"
#include "daemon/station/device/hotplug.h"
#include "daemon/store/file/announced_head.h"
#include "daemon/systemd/notify.h"
#include "daemon/version.h"
#include "daemon/words/error_text.h"
#include "schema/base/database/journal_watch.h"
#include "schema/base/json_writer.h"
#include "schema/base/output/printable.h"

namespace mdof::daemon {
namespace {

// If a thread does not report within this time, the watchdog is not notified any more.
constexpr std::chrono::seconds kThreadDeadline{8};

std::string recorded_json(std::int64_t run, std::int64_t seq) {
  JsonWriter json;
  json.begin_object().field("type", "recorded").field("run", run).field("chunk", seq).end_object();
  return json.take();
}

std::string storage_json(const StorageState& now) {
  JsonWriter json;
  json.begin_object().field("type", "storage").field("state", now.state);
  json.field("text", now.reason).field("utc", utc_now()).end_object();
  return json.take();
}

std::int64_t now_ns(clockid_t clock) {
  timespec now{};
  ::clock_gettime(clock, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

std::string clock_json(double step_s) {
  JsonWriter json;
  json.begin_object().field("type", "clock").field("step_s", step_s);
  json.field("text", "the system clock was changed; the measurement continues");
  json.field("utc", utc_now()).end_object();
  return json.take();
}

std::string compensation_json(std::int64_t generation) {
  JsonWriter json;
  json.begin_object().field("type", "compensation").field("generation", generation);
  json.field("text", "the active table has changed; read the active table again");
  json.field("utc", utc_now()).end_object();
  return json.take();
}

rpc::ServerOptions server_options(const RpcAccess& access) {
  rpc::ServerOptions options;
  options.max_connections = access.connections;
  options.max_connections_of_user = access.connections_of_user;
  options.idle_timeout = access.idle;
  options.kept_for_group = access.cnc_group;
  if (access.approve_group) options.approvers = {*access.approve_group, access.approvers};
  return options;
}

}  // namespace

// The destructor stops the stations and closes the connection that only reads the database. It then
// destroys the storekeeper, which first writes its pending data. At last the other members are
// destroyed: first the server, then the service, then the event loop.
struct App::Parts {
  explicit Parts(Config c)
      : config(std::move(c)),
        table("mdofd", kVersion),
        service(loop.executor(), table, server_options(config.access)) {}

  Config config;
  std::optional<Hotplug> hotplug;
  rpc::EventLoop loop;
  std::unique_ptr<Storekeeper> keeper;
  std::unique_ptr<store::Store> reader;
  ActiveTables active;
  JournalLimit journal;
  SharedDevices shared_devices;
  std::vector<std::unique_ptr<Station>> stations;
  std::unique_ptr<Replayer> replayer;
  std::unique_ptr<QueryThread> query;
  std::unique_ptr<Methods> methods;
  rpc::MethodTable table;
  rpc::Service service;
  rpc::LineServer server{loop, service};
  std::optional<rpc::HttpServer> page;

  ~Parts() {
    for (auto& station : stations) station->begin_stopping();
    replayer.reset();
    query.reset();
    stations.clear();
    // The reader is closed before the writer: the connection that closes last removes the journal
    // files, but a reader cannot remove them.
    reader.reset();
    keeper.reset();
  }
  Status open_store();
  void reopen_reader();
  void start_stations();
  std::optional<DatumSetting> last_datum(Axis axis);
  void report(const char* topic, const std::string& json, std::string_view of = "");
  void log_trouble(Axis axis, const Trouble& trouble);
  void handle_signals();
  Status listen();
  Status serve_page();
  void watch();
  void watch_clock();
  void watch_reader();
  void watch_hotplug();

  ClockWatch clock;
};

Status App::Parts::open_store() {
  Storekeeper::Events events;
  events.recorded = [this](std::int64_t run, std::int64_t seq) {
    loop.post([this, run, seq] { report(kRunTopic, recorded_json(run, seq)); });
  };
  events.failed = [this](std::int64_t run, const Error& error) {
    loop.post([this, run, error] {
      std::fprintf(stderr, "run %lld: %s\n", static_cast<long long>(run),
                   printable(words::text(error)).c_str());
      for (auto& station : stations) {
        if (station->run() == run) station->storage_failed(run, error);
      }
    });
  };
  events.storage_changed = [this](const StorageState& now) {
    loop.post([this, now] {
      std::fprintf(stderr, "storage %s%s%s\n", now.state.c_str(), now.reason.empty() ? "" : ": ",
                   now.reason.c_str());
      if (now.state == "ok") reopen_reader();
      report(kRunTopic, storage_json(now));
    });
  };
  events.head_changed = [](const store::ChainHead& head) {
    std::fprintf(stderr, "the newest link of the chain of hashes is %lld (SHA-256 %s)\n",
                 static_cast<long long>(head.link), head.sha256.c_str());
  };
  MDOF_TRY(keeper, Storekeeper::start({config.database, config.durability, config.commit_interval},
                                      std::move(events)));
  MDOF_TRY(auto opened, store::Store::open(config.database, store::Access::read_only));
  reader = std::make_unique<store::Store>(std::move(opened));
  MDOF_TRY(active, load_active(*reader));
  if (const StorageState now = keeper->storage(); now.state != "ok")
    std::fprintf(stderr, "storage %s: %s\n", now.state.c_str(), now.reason.c_str());
  return {};
}

// The reader may have opened the database as immutable while the database was not writable.
void App::Parts::reopen_reader() {
  auto opened = store::Store::open(config.database, store::Access::read_only);
  if (opened) *reader = std::move(*opened);
  if (query) query->open_again();
}

void App::Parts::start_stations() {
  StationEvents events;
  events.run_event = [this](std::string json) {
    loop.post([this, json = std::move(json)] { report(kRunTopic, json); });
  };
  events.trouble = [this](Axis axis, std::int64_t run, const Trouble& trouble) {
    loop.post([this, axis, run, trouble] {
      report(kRunTopic, trouble_json(axis, run, trouble));
      log_trouble(axis, trouble);
    });
  };
  for (auto& axis : config.axes) {
    events.live = [this, of = std::string(1, letter(axis.rig.axis))](std::string json) {
      loop.post([this, of, json = std::move(json)] { report(kLiveTopic, json, of); });
    };
    stations.push_back(std::make_unique<Station>(axis, config.measure, config.text,
                                                 config.recordings, *keeper, events,
                                                 last_datum(axis.rig.axis), &shared_devices));
  }
}

// The axis position that a user set last. A position that cannot be read is reported and ignored.
std::optional<DatumSetting> App::Parts::last_datum(Axis axis) {
  auto last = reader->last_datum(axis);
  if (last) return std::move(*last);
  std::fprintf(
      stderr,
      "axis %c: the axis position that a user set last cannot be read from the database: %s\n",
      letter(axis), words::text(last.error()).c_str());
  return std::nullopt;
}

// A message that cannot be sent is counted. The next message contains this count, and the journal
// contains the cause.
void App::Parts::report(const char* topic, const std::string& json, std::string_view of) {
  const Status reported = service.publish(topic, json, of);
  if (reported) return;
  const auto now = std::chrono::steady_clock::now();
  if (const auto text =
          journal.admit(std::string("publish ") + topic, reported.error().message, now))
    std::fprintf(stderr, "%s\n", printable(*text).c_str());
}

void App::Parts::log_trouble(Axis axis, const Trouble& trouble) {
  const std::string line = std::string("axis ") + letter(axis) + ": " + trouble_line(trouble);
  const std::string key = std::string(1, letter(axis)) + to_string(trouble.kind) + trouble.device;
  if (const auto text = journal.admit(key, line, std::chrono::steady_clock::now()))
    std::fprintf(stderr, "%s\n", printable(*text).c_str());
}

Status App::Parts::listen() {
  service.add_topic({.name = kLiveTopic});
  service.add_topic(
      {.name = kRunTopic, .event = true, .min_interval = std::chrono::milliseconds(0)});
  replayer = std::make_unique<Replayer>(*keeper);
  MDOF_TRY(auto opened, store::Store::open(config.database, store::Access::read_only));
  query = std::make_unique<QueryThread>(loop.executor(), config.database, std::move(opened));
  methods = std::make_unique<Methods>(Methods{loop, *keeper, *reader, *query, stations, active,
                                              config.database.string(), utc_now(),
                                              std::chrono::steady_clock::now()});
  methods->replayer = replayer.get();
  methods->announce = [this](std::int64_t generation) {
    report(kRunTopic, compensation_json(generation));
  };
  methods->clients = [this] { return service.clients(); };
  MDOF_TRY(methods->generation, reader->generation());
  // The generation never decreases, even if the activation that increased the generation was lost.
  methods->generation =
      std::max(methods->generation, store::read_announced_head(config.database).generation);
  add_all_methods(table, *methods);
  if (config.http) MDOF_CHECK(serve_page());
  MDOF_TRY(const auto handed_over, systemd::take_listen_sockets());
  for (const int fd : handed_over) MDOF_CHECK(server.listen_fd(fd));
  if (handed_over.empty()) {
    MDOF_CHECK(make_socket_folder(config.socket));
    MDOF_CHECK(server.listen_unix(config.socket));
  }
  if (config.tcp_port) {
    MDOF_TRY(const auto port, server.listen_tcp("127.0.0.1", *config.tcp_port));
    (void)port;
  }
  return {};
}

Status App::Parts::serve_page() {
  const HttpAccess& http = *config.http;
  auto token = rpc::load_token(http.token_file);
  if (!token) return in_context(http.token_key, std::move(token.error()));
  page.emplace(loop, service, rpc::HttpSetup{.token = std::move(*token), .hosts = http.hosts});
  const auto port = page->listen(http.address, http.port);
  if (!port) return in_context(http.listen_key, port.error());
  methods->page = Page{http_url(http, *port), std::filesystem::absolute(http.token_file).string()};
  return {};
}

// The watchdog is notified only if this loop runs and every thread has reported in time.
void App::Parts::watch() {
  loop.call_every(std::chrono::milliseconds(50), [this] {
    const auto wanted = service.wanted_interval(kLiveTopic);
    for (auto& station : stations) station->watch(wanted);
  });
  if (const auto interval = systemd::watchdog_interval()) {
    loop.call_every(*interval, [this] {
      const auto now = std::chrono::steady_clock::now();
      bool all = now - keeper->last_turn() < kThreadDeadline;
      for (const auto& station : stations) all = all && station->healthy(kThreadDeadline);
      if (all) systemd::feed_watchdog();
    });
  }
  loop.call_every(std::chrono::seconds(1), [this] {
    watch_clock();
    watch_reader();
  });
  watch_hotplug();
}

void App::Parts::watch_reader() {
  std::string damage = reader->damage();
  if (damage.empty()) damage = query->take_damage();
  if (damage.empty()) return;
  keeper->note_damage(damage);
  reopen_reader();
}

void App::Parts::watch_clock() {
  const auto step_ns = clock.look(now_ns(CLOCK_REALTIME), now_ns(CLOCK_BOOTTIME));
  if (!step_ns) return;
  const double step_s = static_cast<double>(*step_ns) * 1e-9;
  std::fprintf(stderr, "the system clock was changed by %.3f s; the measurement continues\n",
               step_s);
  report(kRunTopic, clock_json(step_s));
}

// A signal that arrives during start-up is pending until the loop runs. The loop then ends at once.
void App::Parts::handle_signals() {
  std::vector<int> signals{SIGTERM, SIGINT};
  struct sigaction hang_up {};
  ::sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN)
    signals.push_back(SIGHUP);  // an ignored SIGHUP stays ignored (nohup)
  loop.on_signal(signals, [this](int) {
    systemd::notify_stopping("stopping");
    loop.stop();
  });
}

// If udev cannot be watched, a lost device is opened again only after the waiting time of its
// thread.
void App::Parts::watch_hotplug() {
  auto watched = Hotplug::watch();
  if (!watched) {
    std::fprintf(stderr, "%s\n", words::text(watched.error()).c_str());
    return;
  }
  hotplug.emplace(std::move(*watched));
  loop.on_readable(hotplug->descriptor(), [this] {
    if (!hotplug->read_arrivals()) return;
    for (auto& station : stations) station->wake_devices();
  });
}

App::App(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
App::~App() = default;

Result<std::unique_ptr<App>> App::create(Config config) {
  sqlite::survive_truncated_shm();
  auto parts = std::make_unique<Parts>(std::move(config));
  parts->handle_signals();
  MDOF_CHECK(parts->open_store());
  parts->start_stations();
  MDOF_CHECK(parts->listen());
  parts->watch();
  return std::unique_ptr<App>(new App(std::move(parts)));
}

void App::run() {
  const auto& page = parts_->methods->page;
  const std::string where =
      "serving on " + parts_->config.socket + (page ? " and " + page->url : "");
  systemd::notify_ready(where);
  std::fprintf(stderr, "%s: %s\n", kVersion, where.c_str());
  parts_->loop.run();
}

}  // namespace mdof::daemon
