// Passes lines of JSON-RPC to the dispatcher and to a method that has a parameter of each type.
// For any input, the output is empty or one line of JSON within the size limit.
#include <simdjson.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "daemon/rpc/net/event_loop.h"
#include "daemon/rpc/session/dispatcher.h"
#include "schema/base/json_writer.h"

namespace {

using namespace mdof;
using namespace mdof::rpc;

class Anybody : public Caller {
 public:
  std::optional<Credentials> credentials() const override { return Credentials{}; }
  bool may_write() const override { return false; }
  bool over_http() const override { return false; }
  bool in_group(gid_t) const override { return false; }
  std::vector<gid_t> further_groups() const override { return {}; }
  Status subscribe(std::string_view, std::chrono::milliseconds) override { return {}; }
  Status unsubscribe(std::string_view) override { return {}; }
};

Result<std::string> echo(const Params& params) {
  JsonWriter json;
  json.begin_object().field("text", params.string("text", "none"));
  json.field("at_mm", params.number("at_mm", 1)).field("count", params.integer("count", 2));
  json.field("both", params.boolean("both"));
  if (params.has("any")) json.key("any").raw(params.json("any"));
  if (params.has("runs")) {
    if (const auto runs = params.integers("runs")) json.field("runs", runs->size());
    if (const auto numbers = params.numbers("runs")) json.field("numbers", numbers->size());
    if (const auto names = params.strings("runs")) json.field("names", names->size());
  }
  return json.end_object().take();
}

const MethodTable& methods() {
  static const MethodTable& made = *[] {
    auto* table = new MethodTable("fuzz", "1");
    table->add({.name = "echo",
                .summary = "Gives back its parameters.",
                .params = {{"text", ParamType::string, ""},
                           {"at_mm", ParamType::number, ""},
                           {"count", ParamType::integer, ""},
                           {"both", ParamType::boolean, ""},
                           {"runs", ParamType::array, ""},
                           {"any", ParamType::object, ""}},
                .result = "the parameters",
                .handler = SyncHandler(echo)});
    table->add(
        {.name = "write",
         .summary = "May not be called.",
         .result = "nothing",
         .writes = true,
         .handler = SyncHandler([](const Params&) -> Result<std::string> { std::abort(); })});
    return table;
  }();
  return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static EventLoop& loop = *new EventLoop;
  static const ServerOptions& options = *new ServerOptions;
  static Dispatcher& dispatcher = *new Dispatcher(loop.executor(), methods(), options);
  static simdjson::dom::parser& parser = *new simdjson::dom::parser;
  std::string line(reinterpret_cast<const char*>(data), std::min(size, options.max_line_bytes));
  const std::size_t length = line.size();
  line.append(Dispatcher::kPadding, '}');
  std::string out;
  Anybody caller;
  BegunBatch batch;
  dispatcher.handle(std::string_view(line).substr(0, length), caller, {}, out, batch,
                    Dispatcher::Clock::time_point::max());
  if (out.empty()) return 0;
  if (out.size() >= options.max_reply_bytes || out.find('\n') != std::string::npos) std::abort();
  if (parser.parse(out).error()) std::abort();
  return 0;
}
