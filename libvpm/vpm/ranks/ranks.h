// The processes that make a picture together, as mpiexec starts them: ranks 0 to size - 1. Rank 0 leads.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace vpm {

struct Message {
  int from = 0;  // a rank
  std::string bytes;
};

class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  bool leads() const { return rank() == 0; }

  /// Returns once the bytes are on their way, or once the other rank reads them. Any thread may send.
  virtual void send(int to, const std::string& bytes) = 0;
  /// A message that has come; messages of one rank come in the order in which it sent them. One
  /// thread at a time may ask, also while others send.
  virtual std::optional<Message> poll() = 0;

  /// The ranks of this one's machine, in the same order, with numbers and messages of their own; null where it is the
  /// only one there. All ranks must ask for it if one does. It lives as long as this.
  virtual Ranks* machine() = 0;

  /// Ends all ranks with this exit status, after what was printed: it does not return.
  virtual void abort(int status) = 0;
};

/// Joins the ranks that this process was started with. It is one of one where vpm is built without MPI. Throws
/// InputError where such a vpm is started as one of several, which would all do the same.
std::unique_ptr<Ranks> join_ranks();

/// How many ranks this process was started with, as those who start them say.
int started_ranks();

/// Waits for the next message, for milliseconds at a time. It can be given up.
Message wait_for_message(Ranks& ranks);

}  // namespace vpm
