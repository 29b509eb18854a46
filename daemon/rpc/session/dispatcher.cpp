#include "daemon/rpc/session/dispatcher.h"

#include <simdjson.h>

#include <string_view>
#include <utility>

#include "daemon/rpc/codes.h"
#include "daemon/rpc/message.h"
#include "daemon/rpc/params/param_values.h"
#include "daemon/rpc/request.h"
#include "daemon/words/error_text.h"

namespace mdof::rpc {

static_assert(Dispatcher::kPadding >= simdjson::SIMDJSON_PADDING);

struct Dispatcher::Parser {
  Parser(std::shared_ptr<Executor> loop, const MethodTable& methods, const ServerOptions& limits)
      : executor(std::move(loop)), table(methods), options(limits) {}

  // The arguments of handle() for one message.
  struct Message {
    std::string_view text;
    Caller& caller;
    std::weak_ptr<ReplySink> sink;
    std::string& out;
    BegunBatch& batch;
    Clock::time_point until;
  };

  Handled handle(const Message& message);
  Handled handle_single(const Message& message, const simdjson::dom::element& parsed);
  Handled handle_batch(const Message& message, const simdjson::dom::array& batch);
  bool begin_batch(const Message& message, std::size_t members) const;
  void call_member(const Message& message, const Request& request,
                   const std::shared_ptr<Exchange>& exchange);
  // Finds the method and checks its parameters (result in `values`), or returns the error of the
  // request.
  struct Refusal {
    int code;
    std::string message, data;
  };
  tl::expected<const Method*, Refusal> prepare(const Request& request, const Caller& caller);

  ReplyLimits limits() const { return {options.max_reply_bytes, options.max_id_bytes}; }

  std::shared_ptr<Executor> executor;
  const MethodTable& table;
  const ServerOptions& options;
  simdjson::dom::parser json;
  ParamValues values;
};

namespace {

std::string reason(simdjson::error_code error, const ServerOptions& options) {
  switch (error) {
    case simdjson::UTF8_ERROR:
      return "the line is not UTF-8";
    case simdjson::DEPTH_ERROR:
      return "the JSON is nested deeper than " + std::to_string(options.max_depth) + " levels";
    case simdjson::NUMBER_ERROR:
      return "a number is malformed or too large";
    default:
      return {};
  }
}

std::string not_an_approver(const std::string& method, const std::string& group,
                            const Caller& caller) {
  const auto who = caller.credentials();
  return method + " is reserved for members of the group " + group +
         " (approve_group in [rpc] of mdofd.toml), but " +
         (who                  ? "uid " + std::to_string(who->uid)
          : caller.over_http() ? std::string("a web page")
                               : std::string("a TCP client")) +
         " is not a member; ask a member to make this call, or become a member and connect again "
         "to the Unix socket";
}

std::string may_not_write(const std::string& method, const Caller& caller) {
  if (!caller.over_http()) return method + " changes data; call this method over the Unix socket";
  return words::text({ErrorCode::usage,
                      method + " changes data and needs the token of mdofd in the header \"" +
                          "Authorization: Bearer TOKEN\"",
                      Remedy::show_token});
}

}  // namespace

Handled Dispatcher::Parser::handle(const Message& message) {
  simdjson::dom::element parsed;
  const auto error =
      json.parse(message.text.data(), message.text.size(), /*realloc_if_needed=*/false).get(parsed);
  if (error) {
    append_error(message.out, "null", kParseError, "Parse error", reason(error, options));
    return {};
  }
  simdjson::dom::array batch;
  return parsed.get(batch) ? handle_single(message, parsed) : handle_batch(message, batch);
}

tl::expected<const Method*, Dispatcher::Parser::Refusal> Dispatcher::Parser::prepare(
    const Request& request, const Caller& caller) {
  if (request.invalid)
    return tl::unexpected(Refusal{kInvalidRequest, "Invalid Request", *request.invalid});
  const Method* method = table.find(request.method);
  if (method == nullptr) {
    const std::string near = table.nearest(request.method);
    return tl::unexpected(Refusal{kMethodNotFound, "Method not found",
                                  near.empty() ? "" : "did you mean " + in_quotes(near) + "?"});
  }
  if (method->writes && !caller.may_write())
    return tl::unexpected(Refusal{kForbidden, may_not_write(method->name, caller), ""});
  if (method->subscribes && caller.over_http())
    return tl::unexpected(Refusal{
        kForbidden, method->name + " is not available through POST /rpc; use GET /events", ""});
  if (method->approves && options.approvers && !caller.in_group(options.approvers->id))
    return tl::unexpected(
        Refusal{kForbidden, not_an_approver(method->name, options.approvers->name, caller), ""});
  if (const Status status = check_params(*method, request.params, values); !status)
    return tl::unexpected(Refusal{kInvalidParams, status.error().message, ""});
  return method;
}

// Handles a message with one request, the usual case. This function allocates no memory itself.
Handled Dispatcher::Parser::handle_single(const Message& message,
                                          const simdjson::dom::element& parsed) {
  const Request request = read_request(parsed, {message.text, std::nullopt}, options.max_id_bytes);
  const auto method = prepare(request, message.caller);
  const auto* sync = method ? std::get_if<SyncHandler>(&(*method)->handler) : nullptr;
  if (method && sync == nullptr) {
    auto exchange = std::make_shared<Exchange>(limits(), 1, false, message.sink);
    call_member(message, request, exchange);
    return {!exchange->seal(message.out), false};
  }
  if (method) {
    const Result<std::string> result = (*sync)(Params(values, message.caller));
    if (!request.id.empty()) append_reply(message.out, request.id, result, options.max_reply_bytes);
  } else if (!request.id.empty()) {
    const Refusal& no = method.error();
    append_error(message.out, request.id, no.code, no.message, no.data);
  }
  return {};
}

Handled Dispatcher::Parser::handle_batch(const Message& message,
                                         const simdjson::dom::array& batch) {
  BegunBatch& begun = message.batch;
  if (!begun.exchange && !begin_batch(message, batch.size())) return {};
  std::size_t i = 0;
  bool called = false;
  for (const simdjson::dom::element member : batch) {
    const std::size_t number = i++;
    if (number < begun.next) continue;
    if (called && Clock::now() > message.until) return {false, true};
    call_member(message, read_request(member, {message.text, number}, options.max_id_bytes),
                begun.exchange);
    called = true;
    begun.next = i;
  }
  return {!std::exchange(begun, {}).exchange->seal(message.out), false};
}

bool Dispatcher::Parser::begin_batch(const Message& message, std::size_t members) const {
  if (members == 0 || members > options.max_batch) {
    append_error(message.out, "null", kInvalidRequest, "Invalid Request",
                 members == 0 ? ""
                              : "a batch may have at most " + std::to_string(options.max_batch) +
                                    " members; divide the batch");
    return false;
  }
  message.batch = {std::make_shared<Exchange>(limits(), members, true, message.sink), 0};
  return true;
}

void Dispatcher::Parser::call_member(const Message& message, const Request& request,
                                     const std::shared_ptr<Exchange>& exchange) {
  const auto method = prepare(request, message.caller);
  if (!method) {
    const Refusal& no = method.error();
    return exchange->answer_error(request.id, no.code, no.message, no.data);
  }
  const Params params(values, message.caller);
  if (const auto* sync = std::get_if<SyncHandler>(&(*method)->handler))
    return exchange->answer(request.id, (*sync)(params));
  auto slot = std::make_unique<Reply::Slot>(Reply::Slot{executor, exchange, request.id});
  std::get<AsyncHandler>((*method)->handler)(params, Reply(std::move(slot)));
}

Dispatcher::Dispatcher(std::shared_ptr<Executor> executor, const MethodTable& table,
                       const ServerOptions& options)
    : parser_(std::make_unique<Parser>(std::move(executor), table, options)) {
  [[maybe_unused]] const auto error =
      parser_->json.allocate(options.max_line_bytes, options.max_depth);
  assert(!error && "no memory for the parser");
}

Dispatcher::~Dispatcher() = default;

Handled Dispatcher::handle(std::string_view message, Caller& caller, std::weak_ptr<ReplySink> sink,
                           std::string& out, BegunBatch& batch, Clock::time_point until) {
  return parser_->handle({message, caller, std::move(sink), out, batch, until});
}

}  // namespace mdof::rpc
