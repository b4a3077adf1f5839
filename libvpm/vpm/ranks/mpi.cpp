// Ranks by MPI.
#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "vpm/base/error.h"
#include "vpm/ranks/ranks.h"

namespace vpm {
namespace {

constexpr int kHead = 1, kBytes = 2;                 // tags: how many bytes a message has, and these
constexpr uint64_t kMostAtOnce = uint64_t{1} << 30;  // bytes: counts are ints

/// MPI's own errors end the job, with a message.
class MpiRanks final : public Ranks {
 public:
  /// Those of a communicator, which this frees at its end; it then ends MPI, too, if asked to.
  MpiRanks(MPI_Comm all, bool ends_mpi) : all_(all), ends_mpi_(ends_mpi) {
    MPI_Comm_rank(all_, &rank_);
    MPI_Comm_size(all_, &size_);
  }
  ~MpiRanks() override {
    machine_.reset();
    MPI_Comm_free(&all_);
    if (ends_mpi_) MPI_Finalize();
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

  Ranks* machine() override {
    if (!machine_) {
      MPI_Comm here = MPI_COMM_NULL;
      MPI_Comm_split_type(all_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);  // of equal keys: in the same order
      machine_ = std::make_unique<MpiRanks>(here, false);
    }
    return machine_->size() > 1 ? machine_.get() : nullptr;
  }

  void abort(int status) override {
    std::fflush(nullptr);
    MPI_Abort(all_, status);
  }

 private:
  MPI_Comm all_;
  bool ends_mpi_;
  int rank_ = 0, size_ = 1;
  std::unique_ptr<MpiRanks> machine_;
};

}  // namespace

std::unique_ptr<Ranks> join_ranks() {
  int there = 0;
  MPI_Initialized(&there);
  int threads = MPI_THREAD_SINGLE;
  if (there)
    MPI_Query_thread(&threads);
  else
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_MULTIPLE, &threads);
  if (threads < MPI_THREAD_MULTIPLE)
    throw InputError("this MPI lets one thread alone send messages; vpm needs one with MPI_THREAD_MULTIPLE");
  MPI_Comm all = MPI_COMM_NULL;
  MPI_Comm_dup(MPI_COMM_WORLD, &all);  // apart from what others in this process send
  return std::make_unique<MpiRanks>(all, !there);
}

}  // namespace vpm
