#include "daemon/rpc/session/exchange.h"

#include <cassert>
#include <utility>

#include "daemon/rpc/codes.h"
#include "daemon/rpc/message.h"

namespace mdof::rpc {
namespace {

constexpr std::string_view kTooLargeForBatch =
    "the reply to the batch is too large; send this call separately";

std::string too_large(std::size_t bytes, std::size_t max_bytes) {
  return "the result has " + std::to_string(bytes) +
         " bytes (limit of a reply line: " + std::to_string(max_bytes) +
         "); request a part of the result (offset, count)";
}

}  // namespace

void append_reply(std::string& out, std::string_view id, const Result<std::string>& result,
                  std::size_t max_bytes) {
  if (!result) return append_error(out, id, result.error());
  const std::size_t begin = out.size();
  append_result(out, id, *result);
  if (out.size() - begin < max_bytes) return;  // "<", because a line end follows
  out.resize(begin);
  append_error(out, id, kReplyTooLarge, too_large(result->size(), max_bytes));
}

Exchange::Exchange(ReplyLimits limits, std::size_t members, bool batch,
                   std::weak_ptr<ReplySink> sink)
    : limits_(limits), open_(members), batch_(batch), sink_(std::move(sink)) {}

void Exchange::answer(std::string_view id, const Result<std::string>& result) {
  if (!id.empty()) {
    std::string message;
    append_reply(message, id, result, limits_.max_bytes);
    take(id, message);
  }
  member_done();
}

void Exchange::answer_error(std::string_view id, int code, std::string_view message,
                            std::string_view data) {
  if (!id.empty()) {
    std::string text;
    append_error(text, id, code, message, data);
    take(id, text);
  }
  member_done();
}

// Adds the answer to one request of a batch. Reserves space for a short error message for each
// request that has no answer yet; each request can therefore be answered. An answer that does not
// fit is replaced by such an error message.
void Exchange::take(std::string_view id, const std::string& message) {
  constexpr std::size_t kBrackets = 3;  // [ ] and a line end
  const std::size_t kept = (open_ - 1) * (kReserveBytes + limits_.max_id_bytes) + kBrackets;
  if (!text_.empty()) text_ += ',';
  if (batch_ && text_.size() + message.size() + kept > limits_.max_bytes)
    append_error(text_, id, kReplyTooLarge, kTooLargeForBatch);
  else
    text_ += message;
}

void Exchange::member_done() {
  assert(open_ > 0);
  if (--open_ > 0 || !sealed_) return;
  std::string reply;
  append_to(reply);
  if (const auto sink = sink_.lock()) sink->finish(reply);
}

bool Exchange::seal(std::string& out) {
  sealed_ = true;
  if (open_ > 0) return false;
  append_to(out);
  return true;
}

void Exchange::append_to(std::string& out) const {
  if (text_.empty()) return;
  if (batch_) out += '[';
  out += text_;
  if (batch_) out += ']';
}

Reply::Reply(std::unique_ptr<Slot> slot) : slot_(std::move(slot)) {}
Reply::Reply(Reply&&) noexcept = default;

Reply& Reply::operator=(Reply&& other) noexcept {
  std::swap(slot_, other.slot_);  // the destructor of `other` answers the call of the previous slot
  return *this;
}

Reply::~Reply() {
  if (!slot_) return;
  const auto executor = slot_->executor;
  executor->dispatch([slot = std::shared_ptr(std::move(slot_))] {
    slot->exchange->answer_error(slot->id, kInternalError, "Internal error",
                                 "the call ended without an answer");
  });
}

std::weak_ptr<const void> Reply::client() const {
  assert(slot_ && "the call has already been answered");
  return slot_->exchange->sink();
}

void Reply::operator()(Result<std::string> result) {
  assert(slot_ && "a call may be answered only once");
  const auto executor = slot_->executor;
  executor->dispatch([slot = std::shared_ptr(std::move(slot_)), answer = std::move(result)] {
    slot->exchange->answer(slot->id, answer);
  });
}

}  // namespace mdof::rpc
