#include "dice/dice.h"

namespace tessera {
namespace {

constexpr cl_uint hideAll = 0;  // HIDE_ALL, HIDE_DEPTH, HIDE_ID of film/hide.clh
constexpr cl_uint hideDepth = 1;
constexpr cl_uint hideId = 2;

}  // namespace

void enqueueDiceHide(DeviceSession& session, const frame_params& frame, const split_limits& limits, const SplitQueues& queues,
                     const PatchSet& patches, const Film& film, bool emulateAtomics) {
    const auto hide = [&](cl_uint pass) {
        session.launch(session.kernels.with("dice_hide", frame, limits, queues.state(), queues.ready(), patches.eyePoints.cl(),
                                            patches.placed.cl(), patches.records.cl(), film.samples(), film.touched(), pass),
                       "dice_hide");
    };
    if (emulateAtomics || !session.device.info.atomics64) {
        hide(hideDepth);
        hide(hideId);
    } else {
        hide(hideAll);
    }
}

}  // namespace tessera
