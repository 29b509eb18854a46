#include "daemon/rpc/net/event_loop.h"

#include <utility>

#include "daemon/rpc/net/event_loop_core.h"

namespace mdof::rpc {
namespace {

using Clock = std::chrono::steady_clock;

// The pending wait holds a reference to the Ticker, so that the Ticker is not destroyed.
struct Ticker : std::enable_shared_from_this<Ticker> {
  Ticker(asio::io_context& context, Clock::duration every, std::function<void()> call)
      : timer(context), period(every), work(std::move(call)), due(Clock::now()) {}

  void wait() {
    const auto now = Clock::now();
    due += period;
    if (due < now) due += (now - due) / period * period + period;
    timer.expires_at(due);
    timer.async_wait([self = shared_from_this()](const LoopError& error) {
      if (error) return;
      self->work();
      self->wait();
    });
  }

  asio::steady_timer timer;
  Clock::duration period;
  std::function<void()> work;
  Clock::time_point due;
};

struct SignalWatch : std::enable_shared_from_this<SignalWatch> {
  SignalWatch(asio::io_context& context, std::function<void(int)> call)
      : set(context), work(std::move(call)) {}

  void wait() {
    set.async_wait([self = shared_from_this()](const LoopError& error, int number) {
      if (error) return;
      self->work(number);
      self->wait();
    });
  }

  asio::signal_set set;
  std::function<void(int)> work;
};

struct ReadWatch : std::enable_shared_from_this<ReadWatch> {
  ReadWatch(asio::io_context& context, int fd, std::function<void()> call)
      : descriptor(context, fd), work(std::move(call)) {}
  ~ReadWatch() { descriptor.release(); }  // the descriptor belongs to the caller

  void wait() {
    descriptor.async_wait(asio::posix::descriptor_base::wait_read,
                          [self = shared_from_this()](const LoopError& error) {
                            if (error) return;
                            self->work();
                            self->wait();
                          });
  }

  asio::posix::stream_descriptor descriptor;
  std::function<void()> work;
};

}  // namespace

EventLoop::EventLoop() : core_(std::make_shared<Core>()) {}

EventLoop::~EventLoop() {
  {
    const std::scoped_lock lock(core_->mutex);
    core_->open = false;
  }
  core_->context.reset();  // outside the lock, because destroyed objects may post
}

std::shared_ptr<Executor> EventLoop::executor() const {
  return core_;
}

void EventLoop::run() {
  const auto stay = asio::make_work_guard(*core_->context);
  core_->context->restart();
  core_->context->run();
}

void EventLoop::stop() {
  const std::scoped_lock lock(core_->mutex);
  if (core_->open) core_->context->stop();
}

void EventLoop::post(std::function<void()> work) {
  core_->post(std::move(work));
}

void EventLoop::call_every(std::chrono::nanoseconds period, std::function<void()> work) {
  std::make_shared<Ticker>(*core_->context, period, std::move(work))->wait();
}

void EventLoop::on_signal(const std::vector<int>& signals, std::function<void(int)> work) {
  auto watch = std::make_shared<SignalWatch>(*core_->context, std::move(work));
  for (const int number : signals) watch->set.add(number);
  watch->wait();
}

void EventLoop::on_readable(int descriptor, std::function<void()> work) {
  std::make_shared<ReadWatch>(*core_->context, descriptor, std::move(work))->wait();
}

}  // namespace mdof::rpc
