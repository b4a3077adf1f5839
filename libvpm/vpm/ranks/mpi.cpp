// Ranks by MPI.
#include <mpi.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <thread>

#include "vpm/base/error.h"
#include "vpm/ranks/ranks.h"

namespace vpm {
namespace {

constexpr int kHead = 1, kBytes = 2;                 // tags: how many bytes a message has, and these
constexpr uint64_t kMostAtOnce = uint64_t{1} << 30;  // bytes: counts are ints

class MpiMachine final : public Machine {
 public:
  /// Of those of `all` that share a machine with this rank.
  explicit MpiMachine(MPI_Comm all) {
    MPI_Comm_split_type(all, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &ranks_);
    MPI_Comm_rank(ranks_, &rank_);
    MPI_Comm_size(ranks_, &size_);
  }
  ~MpiMachine() override { MPI_Comm_free(&ranks_); }
  MpiMachine(const MpiMachine&) = delete;
  MpiMachine& operator=(const MpiMachine&) = delete;

  int size() const { return size_; }
  bool leads() const override { return rank_ == 0; }

  void tell(const std::string& bytes) override {
    for (int rank = 1; rank < size_; ++rank)
      MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, rank, kBytes, ranks_);
  }

  std::string hear() override {
    MPI_Status status;
    for (int there = 0;;) {
      MPI_Iprobe(0, kBytes, ranks_, &there, &status);
      if (there) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // MPI's own wait would keep a core busy
    }
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    std::string bytes(count, '\0');
    MPI_Recv(bytes.data(), count, MPI_BYTE, 0, kBytes, ranks_, MPI_STATUS_IGNORE);
    return bytes;
  }

 private:
  MPI_Comm ranks_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
};

/// MPI's own errors end the job, with a message.
class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int there = 0;
    MPI_Initialized(&there);
    int threads = MPI_THREAD_SINGLE;
    if (there)
      MPI_Query_thread(&threads);
    else
      MPI_Init_thread(nullptr, nullptr, MPI_THREAD_MULTIPLE, &threads);
    began_ = !there;
    if (threads < MPI_THREAD_MULTIPLE)
      throw InputError("this MPI lets one thread alone send messages; vpm needs one with MPI_THREAD_MULTIPLE");
    MPI_Comm_dup(MPI_COMM_WORLD, &all_);  // apart from what others in this process send
    MPI_Comm_rank(all_, &rank_);
    MPI_Comm_size(all_, &size_);
    machine_.emplace(all_);
  }
  ~MpiRanks() override {
    machine_.reset();
    MPI_Comm_free(&all_);
    if (began_) MPI_Finalize();
  }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void send(int to, const std::string& bytes) override {
    const uint64_t count = bytes.size();
    MPI_Send(&count, 1, MPI_UINT64_T, to, kHead, all_);
    for (uint64_t sent = 0; sent < count; sent += kMostAtOnce)
      MPI_Send(bytes.data() + sent, static_cast<int>(std::min(kMostAtOnce, count - sent)), MPI_BYTE, to, kBytes, all_);
  }

  std::optional<Message> poll() override {
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kHead, all_, &there, &status);
    if (!there) return std::nullopt;
    uint64_t count = 0;
    Message message{status.MPI_SOURCE, {}};
    MPI_Recv(&count, 1, MPI_UINT64_T, message.from, kHead, all_, MPI_STATUS_IGNORE);
    message.bytes.resize(count);
    for (uint64_t had = 0; had < count; had += kMostAtOnce)
      MPI_Recv(message.bytes.data() + had, static_cast<int>(std::min(kMostAtOnce, count - had)), MPI_BYTE, message.from,
               kBytes, all_, MPI_STATUS_IGNORE);
    return message;
  }

  Machine* machine() override { return machine_->size() > 1 ? &*machine_ : nullptr; }

  void abort(int status) override {
    std::fflush(nullptr);
    MPI_Abort(all_, status);
  }

 private:
  MPI_Comm all_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
  bool began_ = false;
  std::optional<MpiMachine> machine_;
};

}  // namespace

std::unique_ptr<Ranks> join_ranks() { return std::make_unique<MpiRanks>(); }

}  // namespace vpm
