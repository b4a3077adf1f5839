// Messages: a rank asks for a number, gets one or the word that there is no more, and sends a pass.
#include "vpm/ranks/together.h"

#include <charconv>
#include <chrono>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "vpm/base/cancel.h"
#include "vpm/integrators/render_scene.h"
#include "vpm/ranks/messages.h"
#include "vpm/ranks/pass_pool.h"

namespace vpm {
namespace {

// The first byte of a message.
constexpr char kAsk = 'a';    // for a number
constexpr char kMake = 'm';   // the pass of this number
constexpr char kPass = 'p';   // a number, a line feed, and its pass
constexpr char kLeave = 'l';  // there is no more to make
constexpr char kLeft = 'd';   // no more messages will come

constexpr std::chrono::microseconds kBetweenPolls{500};
constexpr std::chrono::milliseconds kBetweenLooks{20};  // at whether what waits is to be given up

int number_in(std::string_view text) {
  int number = -1;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// How many passes may be under way or wait to be joined: two for each rank, so that none waits for the slowest.
int passes_ahead(int ranks) { return 2 * ranks; }

PassRange numbers_of(const StopRule& until) {
  return {until.first, until.counts_passes() ? until.first + until.passes : std::numeric_limits<int>::max()};
}

/// What rank 0 does beside joining: a thread answers the others, another makes passes.
class Leader {
 public:
  Leader(Ranks& ranks, PassPool& pool, const PassMaker& maker)
      : ranks_(ranks),
        pool_(pool),
        flags_(cancel_flags),
        asked_to_leave_(ranks.size(), false),
        answering_([this] { answer(); }),
        making_([this, &maker] { make(maker); }) {}
  ~Leader() {
    pool_.close();
    halt_ = true;
    making_.join();
    answering_.join();
  }
  Leader(const Leader&) = delete;
  Leader& operator=(const Leader&) = delete;

 private:
  /// Until all others have left; or, where the work is given up, at once.
  void answer() {
    const CancelledWith leader(flags_);
    while (left_ < ranks_.size() - 1) {
      if (is_cancelled()) {
        halt_ = true;
        pool_.close();
        return;
      }
      if (pool_.closed())
        for (int rank = 1; rank < ranks_.size(); ++rank) ask_to_leave(rank);
      std::erase_if(asking_, [this](int rank) { return answer(rank); });
      if (const std::optional<Message> message = ranks_.poll())
        take(*message);
      else
        std::this_thread::sleep_for(kBetweenPolls);
    }
  }

  void take(const Message& message) {
    const char kind = message.bytes[0];
    if (kind == kPass) deliver(message.bytes);
    if (kind == kAsk) asking_.push_back(message.from);
    if (kind == kLeft) ++left_;
  }

  /// Gives a rank work; false where it has to wait.
  bool answer(int rank) {
    const PassPool::Task task = pool_.try_take();
    if (task.order == PassPool::Order::wait) return false;
    if (task.order == PassPool::Order::make)
      ranks_.send(rank, kMake + std::to_string(task.number));
    else
      ask_to_leave(rank);
    return true;
  }

  /// Once: it is the last message to a rank.
  void ask_to_leave(int rank) {
    if (asked_to_leave_[rank]) return;
    asked_to_leave_[rank] = true;
    ranks_.send(rank, std::string{kLeave});
  }

  void deliver(std::string_view bytes) {
    const size_t line = bytes.find('\n');
    try {
      pool_.deliver(number_in(bytes.substr(1, line - 1)), pass_of(bytes.substr(line + 1)));
    } catch (...) {
      pool_.fail(std::current_exception());
    }
  }

  void make(const PassMaker& passes) {
    const RenderResult none{Film(1, 1), {}, 0.0, {}};
    const CancelScope halted(halt_);
    try {
      for (PassPool::Task task = pool_.take(); task.order == PassPool::Order::make; task = pool_.take()) {
        pool_.deliver(task.number, passes.make(task.number, none, {}));
      }
    } catch (const Cancelled&) {
    } catch (...) {
      pool_.fail(std::current_exception());
    }
  }

  Ranks& ranks_;
  PassPool& pool_;
  const CancelFlags* const flags_;  // of the leading thread
  std::atomic<bool> halt_{false};
  // Of the answering thread:
  std::vector<int> asking_;  // ranks that wait for an answer
  std::vector<bool> asked_to_leave_;
  int left_ = 0;
  std::thread answering_, making_;  // last: they use the rest
};

/// The orders of rank 0 to another rank, also while that makes a pass.
class Orders {
 public:
  explicit Orders(Ranks& ranks) : ranks_(ranks), listening_([this] { listen(); }) {}
  ~Orders() {
    leave_ = true;  // also where a pass could not be made
    listening_.join();
  }
  Orders(const Orders&) = delete;
  Orders& operator=(const Orders&) = delete;

  /// Is there no more to make?
  const std::atomic<bool>& leave() const { return leave_; }
  /// The number of the next pass, once it comes; nothing where there is no more.
  std::optional<int> next() {
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, kBetweenLooks, [this] { return leave_ || number_; })) cancellation_point();
    return leave_ ? std::nullopt : std::exchange(number_, std::nullopt);
  }

 private:
  void listen() {
    while (!leave_) {
      const std::optional<Message> message = ranks_.poll();
      if (message)
        take(*message);
      else
        std::this_thread::sleep_for(kBetweenPolls);
    }
  }

  void take(const Message& message) {
    const std::lock_guard lock(mutex_);
    if (message.bytes[0] == kLeave)
      leave_ = true;
    else
      number_ = number_in(std::string_view(message.bytes).substr(1));
    wake_.notify_one();
  }

  Ranks& ranks_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::atomic<bool> leave_{false};
  std::optional<int> number_;
  std::thread listening_;  // last: it uses the rest
};

void refuse_radii_of_pixels(const PassMaker& maker) {
  refuse_if(maker.ordered, "integrator.radii",
            "where 'radii' of [integrator] are \"per-pixel\" they follow from all passes before, so that no other rank "
            "can make the next pass",
            "write other radii, or render in one process");
}

}  // namespace

RenderResult lead_passes(Ranks& ranks, const StopRule& until, const PassMaker& maker, RenderResult result,
                         const RunControl& control) {
  PassPool pool(numbers_of(until), result.film.sums().passes, passes_ahead(ranks.size()));
  const uint64_t work = maker.work;
  const auto join = [&](int number, const RenderResult&, const PassProgress& progress) {
    Pass pass = pool.join(number);
    if (progress.tiles != nullptr) progress.tiles->advance(work);
    return pass;
  };
  const Leader leader(ranks, pool, maker);
  return run_passes(until, {join, work}, std::move(result), control);
}

void make_passes(Ranks& ranks, const PassMaker& maker) {
  Orders orders(ranks);
  const RenderResult none{Film(1, 1), {}, 0.0, {}};
  try {
    const CancelScope left(orders.leave());
    for (;;) {
      ranks.send(0, std::string{kAsk});
      const std::optional<int> number = orders.next();
      if (!number) break;
      const Pass pass = maker.make(*number, none, {});
      if (orders.leave()) break;
      ranks.send(0, kPass + std::to_string(*number) + "\n" + bytes_of(pass));
    }
  } catch (const Cancelled&) {
    if (is_cancelled()) throw;
  }
  ranks.send(0, std::string{kLeft});
}

RenderResult lead_render(Ranks& ranks, const Scene& scene, const RenderSettings& settings, RenderResult result,
                         const RunControl& control) {
  if (ranks.size() == 1) return render(scene, settings, std::move(result), control);
  const PassMaker maker = pass_maker(scene, settings);
  refuse_radii_of_pixels(maker);
  check_begun(scene, settings, result);
  return lead_passes(ranks, settings.until, maker, std::move(result), control);
}

void make_render(Ranks& ranks, const Scene& scene, const RenderSettings& settings) {
  make_passes(ranks, pass_maker(scene, settings));
}

}  // namespace vpm
