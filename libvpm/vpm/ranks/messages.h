// The messages between ranks: a pass as bytes, and those of rank 0 to the others before a render and after it, so that
// all make passes of one picture, and all may have it.
#pragma once

#include <string>
#include <string_view>

#include "vpm/film/pass.h"
#include "vpm/job/identity.h"
#include "vpm/ranks/ranks.h"
#include "vpm/render/render.h"

namespace vpm {

std::string bytes_of(const Pass& pass);

/// Back to the last bit. Throws FieldError where the bytes are no pass.
Pass pass_of(std::string_view bytes);

/// Sends all other ranks what is to be rendered; called by rank 0.
void send_render(Ranks& ranks, const Identity& identity);

/// The message of send_render(), once it comes. Throws std::runtime_error where rank 0 is another program.
Identity receive_render(Ranks& ranks);

/// Makes the choices that rank 0 has made for a job in which settings are left to be chosen. Throws InputError where
/// this rank's scene, program or options are others.
void adopt_render(RenderJob& job, const Identity& led);

/// Sends all other ranks what was rendered, to the last bit; called by rank 0.
void send_result(Ranks& ranks, const RenderResult& result);

/// The message of send_result(), once it comes. Throws FieldError where the message is something else.
RenderResult receive_result(Ranks& ranks);

}  // namespace vpm
