// mdof record: measures a run of an axis and shows its progress: point k of n, the next target.
// mdofd measures the run. This command only starts the run and shows it. If the command ends, the
// run continues, unless the user requests its end.
#include <CLI/CLI.hpp>
#include <cmath>

#include "daemon/rpc/line/client.h"
#include "daemon/words/words.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/measure/live_view.h"
#include "tools/mdof/interrupt.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/stored/stored_run.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/json_text.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using simdjson::dom::element;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kEventWait{200};      // largest delay after Ctrl-C
constexpr milliseconds kEndPatience{30000};  // time limit for the evaluation of a run

struct RecordCommand {
  std::string socket, axis, note;
  std::vector<double> targets_mm;
  std::optional<double> from_mm, to_mm, interval_mm, jitter_mm, scale_period_um, for_s;
  std::int64_t repeats = 0, seed = 1, resume = 0;
  bool json = false;
};

std::string start_params(const RecordCommand& c) {
  JsonWriter json;
  json.begin_object().field("axis", c.axis).field("note", c.note);
  if (c.repeats > 0) json.field("repeats", c.repeats);
  if (!c.targets_mm.empty()) {
    json.key("targets_mm").begin_array();
    for (const double target_mm : c.targets_mm) json.value(target_mm);
    json.end_array();
  }
  const auto number = [&](const char* key, const std::optional<double>& value) {
    if (value) json.field(key, *value);
  };
  number("from_mm", c.from_mm);
  number("to_mm", c.to_mm);
  number("interval_mm", c.interval_mm);
  number("jitter_mm", c.jitter_mm);
  number("scale_period_um", c.scale_period_um);
  if (c.jitter_mm) json.field("seed", c.seed);
  json.end_object();
  return json.take();
}

Result<std::string> begin(rpc::Client& client, const RecordCommand& c) {
  if (c.resume == 0) return client.call("run.start", start_params(c));
  JsonWriter params;
  params.begin_object().field("run", c.resume).end_object();
  return client.call("run.resume", params.text());
}

void warn_wrapped(std::string_view words) {
  say(wrapped("warning: " + std::string(words), terminal_columns(), 2));
}

// "point 3 of 26, next 15.000 mm". If the run has no targets or no repeats, the unknown numbers are
// omitted. The first number counts each requested point once, as soon as the errors of this point
// are solved. The text also states the number of other points.
std::string progress_line(const auto& event) {
  const std::int64_t all = integer(event, "points").value_or(0);
  const std::int64_t points = integer(event, "done").value_or(all);
  const auto of = integer(event, "of");
  std::string line = "point " + std::to_string(points);
  if (of) line += " of " + std::to_string(*of);
  if (all > points)
    line +=
        " (other points, without error values or not requested: " + std::to_string(all - points) +
        (of && all >= *of ? "; the run ends when all requested points have error values, or with "
                            "Ctrl-C"
                          : "") +
        ")";
  const double awaited_mm = number(event, "awaited_mm");
  return points == of || std::isnan(awaited_mm) ? line
                                                : line + ", next " + fixed(awaited_mm, 3) + " mm";
}

// Shows the event. If the run of the axis has ended, returns the number of the run that has the
// result.
std::optional<std::int64_t> handle_event(std::string_view notification, std::int64_t run,
                                         const std::string& axis) {
  simdjson::dom::parser parser;
  const auto event = parser.parse(simdjson::padded_string(notification))["params"]["value"];
  if (text(event, "axis") != axis) return std::nullopt;
  if (const auto trouble = read_trouble(notification)) warn_wrapped(trouble->line);
  const std::string type = text(event, "type");
  if (type == "progress" && integer(event, "run") == run)
    say(wrapped(progress_line(event), terminal_columns(), 2));
  return type == "ended" ? integer(event, "run") : std::nullopt;
}

Status ask_to_stop(rpc::Client& client, std::int64_t run) {
  JsonWriter params;
  params.begin_object().field("run", run).end_object();
  const auto stopped = client.call("run.stop", params.text());
  // not_found: the run has ended in the meantime, and its event follows.
  if (stopped || stopped.error().code == ErrorCode::not_found) return {};
  return tl::unexpected(stopped.error());
}

// Waits until the run has ended. Returns the number of the run that has the result.
Result<std::int64_t> follow(rpc::Client& client, std::int64_t run, const RecordCommand& command) {
  // A second signal must not end this command before mdofd has received run.stop.
  std::optional<Interrupt> interrupt(Interrupt::Further::is_ignored);
  const auto begin = steady_clock::now();
  std::optional<steady_clock::time_point> stopped;
  for (;;) {
    const auto notification = client.next_notification(kEventWait);
    if (notification) {
      if (const auto ended = handle_event(*notification, run, command.axis)) return *ended;
    }
    const auto now = steady_clock::now();
    const bool over = command.for_s && now - begin > std::chrono::duration<double>(*command.for_s);
    if (!stopped && (over || Interrupt::requested())) {
      MDOF_CHECK(ask_to_stop(client, run));
      stopped = now;
      say("mdofd ends run " + std::to_string(run) +
          " and evaluates it; Ctrl-C now ends only this command");
      interrupt.reset();
    }
    if (stopped && now - *stopped > kEndPatience)
      return io_error("run " + std::to_string(run) +
                      ": mdofd was asked to end this run, but has not reported its end within " +
                      std::to_string(kEndPatience.count() / 1000) + " s; see mdof status");
    if (!client.connected())
      return in_context(
          "this command no longer receives the progress of run " + std::to_string(run),
          notification.error());
  }
}

// The reason why mdofd cannot store data; empty: it can, or the reason is unknown.
std::string storage_fault(rpc::Client& client) {
  const auto info = client.call("server.info");
  if (!info) return "";
  simdjson::dom::parser parser;
  return text(parser.parse(simdjson::padded_string(*info)), "storage_reason");
}

// Prints the run in the format of `mdof show`. Error: the run differs from the request.
Status print_result(rpc::Client& client, std::int64_t run, const std::string& result,
                    bool as_json) {
  MDOF_CHECK(as_json ? write_line(result)
                     : write_out(stored_run_text(client, run).value_or(readable(result))));
  simdjson::dom::parser parser;
  const std::string state = text(parser.parse(simdjson::padded_string(result)), "state");
  if (state == "complete") return {};
  const std::string id = std::to_string(run);
  if (const std::string fault = storage_fault(client); !fault.empty())
    return fail(ErrorCode::io, "run " + id + " is " + state + "; storage: " + fault);
  return fail(ErrorCode::check,
              "run " + id + " is " + state +
                  (state == "partial" ? ": the notices of the run list the missing points; "
                                        "continue the run with: mdof record --resume " +
                                            id
                                      : "; the notices of the run give the reason"));
}

Status record(RecordCommand command) {
  if (command.axis.empty() && command.resume == 0)
    return fail(ErrorCode::usage,
                "record: missing option --axis AXIS, or --resume RUN to continue a run");
  MDOF_TRY(rpc::Client client, rpc::Client::connect(command.socket));
  MDOF_CHECK(client.call("live.subscribe", R"({"interval_ms":60000,"events":true})"));
  MDOF_TRY(const std::string reply, begin(client, command));
  simdjson::dom::parser parser;
  const auto started = parser.parse(simdjson::padded_string(reply));
  const std::int64_t run = integer(started, "run").value_or(0);
  command.axis = text(started, "axis");
  for (const Notice& each : notices_of(started))
    each.severity == Severity::information
        ? say(wrapped("note: " + words::text(each), terminal_columns(), 2))
        : warn_wrapped(words::line(each));
  say("run " + std::to_string(run) + " of axis " + command.axis +
      " is in progress; Ctrl-C ends the run and evaluates it");
  MDOF_TRY(const std::int64_t id, follow(client, run, command));
  if (id != run)
    say("run " + std::to_string(id) + " contains the result and replaces run " +
        std::to_string(run) +
        ", because mdofd numbered the targets again at the end of the run. \"mdof runs\" lists the "
        "replaced run only with --all");
  JsonWriter params;
  params.begin_object().field("run", id).end_object();
  MDOF_TRY(const std::string result, client.call("run.get", params.text()));
  return print_result(client, id, result, command.json);
}

Action declare_record(CLI::App& command) {
  const auto o = std::make_shared<RecordCommand>();
  auto* axis = command.add_option("--axis", o->axis, "Axis of the machine")
                   ->check(CLI::IsMember({"X", "Y", "Z"}));
  command.add_option("--targets-mm", o->targets_mm, "Targets in ascending order")->delimiter(',');
  command.add_option("--from-mm", o->from_mm, "First target (instead of --targets-mm)");
  command.add_option("--to-mm", o->to_mm, "Upper limit for the last target");
  command.add_option("--interval-mm", o->interval_mm, "Interval between two targets");
  command.add_option("--jitter-mm", o->jitter_mm, "Largest random shift of each target");
  command.add_option("--seed", o->seed, "Seed of the random shifts")
      ->check(not_negative_number())
      ->capture_default_str();
  command.add_option("--scale-period-um", o->scale_period_um,
                     "Signal period of the scale; mdof warns if the target interval hides the "
                     "periodic error of the scale");
  command.add_option("--resume", o->resume, "Continue this run, which ended early")
      ->check(positive_number())
      ->excludes(axis);
  command
      .add_option("--repeats", o->repeats,
                  "End the run after this number of passes over the targets in each direction")
      ->check(CLI::Range(1, 10000));
  command.add_option("--for-s", o->for_s, "End the run after this number of seconds")
      ->check(positive_number());
  command.add_option("--note", o->note, "Note that is stored with the run");
  add_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  return [o] { return record(*o); };
}

}  // namespace

Command record_command() {
  return {.name = "record",
          .summary = "Measure a run with mdofd and show its progress",
          .footer =
              "Without targets, mdofd records all samples and finds the targets from the stops.\n"
              "Examples:\n"
              "  mdof record --axis X --from-mm 0 --to-mm 60 --interval-mm 5 --jitter-mm 0.5 "
              "--repeats 5\n"
              "  mdof record --axis X --for-s 60 --note \"warm-up\"\n"
              "  mdof record --resume 12",
          .declare = declare_record};
}

}  // namespace mdof::tools
