// The connections of a server: a line server or an HTTP server. ClientSet gives turns to the
// connections, checks their time limits regularly, and wakes them when a value is due. Private
// header.
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "daemon/rpc/net/asio.h"
#include "daemon/rpc/net/event_loop_core.h"
#include "daemon/rpc/session/service.h"

namespace mdof::rpc {

// Thread-bound to the event loop. `C`: a ClientSocket with check_times().
template <class C>
struct ClientSet : std::enable_shared_from_this<ClientSet<C>> {
  using Clock = std::chrono::steady_clock;

  ClientSet(std::shared_ptr<EventLoop::Core> event_loop, Service& shared)
      : loop(std::move(event_loop)),
        service(shared),
        sweep_timer_(*loop->context),
        due_timer_(*loop->context) {}
  virtual ~ClientSet() = default;

  void forget(const C& connection) {
    std::erase_if(connections, [&](const auto& c) { return c.get() == &connection; });
  }
  void wake_at(Clock::time_point when) {
    if (due_ && *due_ <= when) return;
    due_ = when;
    due_timer_.expires_at(when);
    due_timer_.async_wait([weak = this->weak_from_this()](const LoopError& error) {
      const auto self = weak.lock();
      if (!self || error) return;  // the set was destroyed, or an earlier time replaced this time
      self->due_.reset();
      self->wake_due();
    });
  }

  std::shared_ptr<EventLoop::Core> loop;
  Service& service;
  std::vector<std::shared_ptr<C>> connections;

 protected:
  // Gives a turn to the next connection. Returns the time at the end of this turn.
  virtual Clock::time_point give_turn(Clock::time_point now) = 0;
  virtual bool has_waiting_clients() const = 0;
  virtual void wake_due() = 0;  // wakes connections whose value is due
  virtual std::chrono::milliseconds least_limit() const = 0;

  void close_all() {
    for (const auto& connection : std::exchange(connections, {})) connection->close();
  }
  void begin(std::shared_ptr<C> connection) {
    connections.push_back(std::move(connection));
    if (!std::exchange(sweeping_, true)) sweep();
  }
  void post_turns() {
    if (std::exchange(turns_posted_, true)) return;
    loop->post([weak = this->weak_from_this()] {
      if (const auto self = weak.lock()) self->give_turns();
    });
  }

 private:
  // Gives turns for at most kSlice, then returns to the loop and continues later. In between, the
  // loop checks sockets and timers. A new request therefore does not wait for all connections that
  // are before it in the queue.
  void give_turns() {
    constexpr std::chrono::microseconds kSlice{300};
    turns_posted_ = false;
    auto now = Clock::now();
    for (const auto end = now + kSlice; has_waiting_clients() && now < end;) now = give_turn(now);
    if (has_waiting_clients()) post_turns();
  }
  // Checks the time limits of all connections. The interval is an eighth of the shortest limit, so
  // that no limit is exceeded by more than an eighth.
  void sweep() {
    for (const auto& connection : std::vector(connections)) connection->check_times(Clock::now());
    if (connections.empty()) {
      sweeping_ = false;
      return;
    }
    using std::chrono::milliseconds;
    sweep_timer_.expires_after(std::clamp(least_limit() / 8, milliseconds(5), milliseconds(250)));
    sweep_timer_.async_wait([weak = this->weak_from_this()](const LoopError& error) {
      if (const auto self = weak.lock(); self && !error) self->sweep();
    });
  }

  bool turns_posted_ = false, sweeping_ = false;
  asio::steady_timer sweep_timer_, due_timer_;
  std::optional<Clock::time_point> due_;
};

}  // namespace mdof::rpc
