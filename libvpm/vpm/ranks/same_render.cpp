// The identity as lines, and the result as a checkpoint has it.
#include "vpm/ranks/same_render.h"

#include <stdexcept>
#include <string>
#include <string_view>

#include "vpm/base/error.h"
#include "vpm/job/checkpoint.h"

namespace vpm {
namespace {

constexpr std::string_view kToRender = "render";

void send_to_others(Ranks& ranks, const std::string& bytes) {
  for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(rank, bytes);
}

}  // namespace

void tell_render(Ranks& ranks, const Identity& identity) { send_to_others(ranks, lines_of(kToRender, identity)); }

Identity told_render(Ranks& ranks) {
  const Message message = wait_for_message(ranks);
  std::string_view text = message.bytes;
  const std::optional<Identity> told = take_lines(text, kToRender);
  if (!told) throw std::runtime_error("rank 0 is another program");
  return *told;
}

void render_as_told(RenderJob& job, const Identity& led) {
  if (job.automatic.any()) choose_again(job, choices_of(led));
  const Identity own = identity_of(job);
  if (own == led) return;
  throw InputError("this rank would render something else: its files, its program or its options differ" +
                   differences(led, own, "of rank 0", "here"));
}

void tell_result(Ranks& ranks, const RenderResult& result) {
  if (ranks.size() > 1) send_to_others(ranks, bytes_of(result));
}

RenderResult told_result(Ranks& ranks) {
  RenderResult result = result_of(wait_for_message(ranks).bytes);
  result.errors = errors_of(result);  // as at the end of a render
  return result;
}

}  // namespace vpm
