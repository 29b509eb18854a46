// Collects the answers to one message, which is one request or a batch, and makes the reply.
// Answers may arrive later. Private header.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "daemon/rpc/reply.h"
#include "daemon/rpc/session/executor.h"
#include "schema/base/result.h"

namespace mdof::rpc {

// Receives replies that were not complete when the message had been handled.
class ReplySink {
 public:
  virtual ~ReplySink() = default;
  // Receives the reply of an exchange. If the reply is empty, nothing must be sent.
  virtual void finish(std::string_view reply) = 0;
};

// Limits of the reply to one message.
struct ReplyLimits {
  std::size_t max_bytes;  // including a line end that a transport may add
  std::size_t max_id_bytes;
};

// Thread-bound to the event loop.
class Exchange {
 public:
  Exchange(ReplyLimits limits, std::size_t members, bool batch, std::weak_ptr<ReplySink> sink);

  // Call either answer() or answer_error() once for each request of the message, in any order. `id`
  // is JSON text; it is empty for a notification.
  void answer(std::string_view id, const Result<std::string>& result);
  void answer_error(std::string_view id, int code, std::string_view message,
                    std::string_view data = {});
  // Call seal() after all requests of the message were called. True: the reply is complete and was
  // appended to `out`; nothing is appended if all requests are notifications. False: the sink
  // receives the reply later.
  bool seal(std::string& out);

  const std::weak_ptr<ReplySink>& sink() const { return sink_; }

  // Bytes that the reply reserves for each request without an answer, in addition to its id.
  static constexpr std::size_t kReserveBytes = 160;

 private:
  void take(std::string_view id, const std::string& message);
  void member_done();
  void append_to(std::string& out) const;

  ReplyLimits limits_;
  std::size_t open_;  // number of requests without an answer
  bool batch_;
  bool sealed_ = false;
  std::weak_ptr<ReplySink> sink_;
  std::string text_;  // messages, separated by commas
};

// Appends the reply to one call. If the result does not fit into `max_bytes`, appends an error
// instead.
void append_reply(std::string& out, std::string_view id, const Result<std::string>& result,
                  std::size_t max_bytes);

struct Reply::Slot {
  std::shared_ptr<Executor> executor;
  std::shared_ptr<Exchange> exchange;
  std::string id;  // JSON text; empty: a notification
};

}  // namespace mdof::rpc
