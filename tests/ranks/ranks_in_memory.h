// Ranks that are threads of one process, for tests of what ranks tell each other.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "vpm/ranks/ranks.h"

namespace vpm {

/// The messages that are under way, by the rank that they are sent to.
class Post {
 public:
  explicit Post(int ranks) : boxes_(ranks) {}
  int ranks() const { return static_cast<int>(boxes_.size()); }
  void send(int from, int to, const std::string& bytes) {
    const std::lock_guard lock(mutex_);
    boxes_.at(to).push_back({from, bytes});
  }
  std::optional<Message> poll(int rank) {
    const std::lock_guard lock(mutex_);
    std::deque<Message>& box = boxes_.at(rank);
    if (box.empty()) return std::nullopt;
    Message message = std::move(box.front());
    box.pop_front();
    return message;
  }
  bool empty() {
    const std::lock_guard lock(mutex_);
    for (const std::deque<Message>& box : boxes_)
      if (!box.empty()) return false;
    return true;
  }

 private:
  std::mutex mutex_;
  std::vector<std::deque<Message>> boxes_;
};

class RankInMemory final : public Ranks {
 public:
  RankInMemory(Post& post, int rank) : post_(post), rank_(rank) {}
  int rank() const override { return rank_; }
  int size() const override { return post_.ranks(); }
  void send(int to, const std::string& bytes) override { post_.send(rank_, to, bytes); }
  std::optional<Message> poll() override { return post_.poll(rank_); }
  Ranks* machine() override { return nullptr; }
  void abort(int) override { throw std::logic_error("a test aborts no ranks"); }

 private:
  Post& post_;
  int rank_;
};

}  // namespace vpm
