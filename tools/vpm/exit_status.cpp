// From exceptions to words.
#include "exit_status.h"

#include <new>

#include "vpm/base/cancel.h"
#include "vpm/base/error.h"
#include "vpm/job/render.h"

namespace vpm::tools {

Failure failure_of(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    return {kBadInput, error.what()};
  } catch (const Cancelled&) {
    return {kInterrupted, "interrupted"};
  } catch (const NoPassFits& failure) {
    return {kNoPassFits, failure.what()};
  } catch (const std::bad_alloc&) {
    return {kFailed, "out of memory"};
  } catch (const std::exception& error) {
    return {kFailed, error.what()};
  }
}

}  // namespace vpm::tools
