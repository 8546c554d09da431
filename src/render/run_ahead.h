// The methods without a host in the loop: iterations are enqueued ahead, and the counts on the device decide what each of them does.
#pragma once

#include "render/split_loop.h"
#include "split/local_queues.h"

namespace tessera {

// At most p ranges at a time. Ends when all is hidden and `loop.finish` has run after that.
[[nodiscard]] SplitReport runBounded(const SplitLoop& loop);
// Stacks in local memory. `local` is reserved for a shape whose batch() is loop.limits.batch; of loop.queues only the room for diceable
// ranges and the counts are used.
[[nodiscard]] SplitReport runLocal(const SplitLoop& loop, LocalQueues& local);

}  // namespace tessera
