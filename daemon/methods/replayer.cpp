#include "daemon/methods/replayer.h"

#include <sys/resource.h>
#include <unistd.h>

#include <memory>

namespace mdof::daemon {
namespace {

constexpr int kNiceness = 10;  // after everything that measures

}  // namespace

Replayer::~Replayer() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

void Replayer::start(ReplayRequest request, const Deed& deed, Done done) {
  if (busy_.exchange(true))
    return done(
        fail(ErrorCode::conflict, "another log is being replayed; try again when it is done"));
  if (thread_.joinable()) thread_.join();  // it has done its work, or is about to have
  thread_ = std::thread([this, request = std::move(request), deed, done = std::move(done)] {
    work(request, deed, done);
  });
}

void Replayer::work(const ReplayRequest& request, const Deed& deed, const Done& done) {
  // Linux: of this thread alone.
  (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), kNiceness);
  auto run = replay(request, [this](const Progress&) { return !stopping_; });
  busy_ = false;  // before the answer: who has it may ask for the next
  if (!run) return done(tl::unexpected(run.error()));
  const auto shared = std::make_shared<Run>(std::move(*run));
  const bool posted = keeper_.post(
      [shared, deed, done](store::Store& store) { done(store.add_run(*shared, deed)); });
  if (!posted) done(io_error("the store is behind with its work; try again"));
}

}  // namespace mdof::daemon
