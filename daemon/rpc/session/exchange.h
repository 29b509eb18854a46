// The reply to one message, single or batch, put together from answers that may come late. Private
// header.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "daemon/rpc/reply.h"
#include "daemon/rpc/session/executor.h"
#include "schema/base/result.h"

namespace mdof::rpc {

// Where a reply goes that could not be given at once.
class ReplySink {
 public:
  virtual ~ReplySink() = default;
  // Ends one exchange that was left open; an empty reply: there is nothing to send.
  virtual void finish(std::string_view reply) = 0;
};

// Of the reply to one message.
struct ReplyLimits {
  std::size_t max_bytes;  // with the line end that a transport may add
  std::size_t max_id_bytes;
};

// Thread-bound: the loop.
class Exchange {
 public:
  Exchange(ReplyLimits limits, std::size_t members, bool batch, std::weak_ptr<ReplySink> sink);

  // One call each a member, in any order; `id` is JSON text, empty for a notification.
  void answer(std::string_view id, const Result<std::string>& result);
  void answer_error(std::string_view id, int code, std::string_view message,
                    std::string_view data = {});
  // After the last member was handed out. True: the reply is complete and was appended to `out`
  // (nothing for notifications alone); false: the sink gets it later.
  bool seal(std::string& out);

  const std::weak_ptr<ReplySink>& sink() const { return sink_; }

  // What a member that is still to be answered keeps of the reply, less its id.
  static constexpr std::size_t kReserveBytes = 160;

 private:
  void take(std::string_view id, const std::string& message);
  void member_done();
  void append_to(std::string& out) const;

  ReplyLimits limits_;
  std::size_t open_;  // members not yet answered
  bool batch_;
  bool sealed_ = false;
  std::weak_ptr<ReplySink> sink_;
  std::string text_;  // messages, comma separated
};

// Appends the reply to one call; a result for which `max_bytes` are too few becomes an error.
void append_reply(std::string& out, std::string_view id, const Result<std::string>& result,
                  std::size_t max_bytes);

struct Reply::Slot {
  std::shared_ptr<Executor> executor;
  std::shared_ptr<Exchange> exchange;
  std::string id;  // JSON text; empty: a notification
};

}  // namespace mdof::rpc
