// Types for structs that host and kernels share. All members are 4 bytes, so both sides lay them out alike.
#ifndef TESSERA_CORE_TYPES_SHARED_H
#define TESSERA_CORE_TYPES_SHARED_H

#ifndef __OPENCL_VERSION__
#include <cstdint>
namespace tessera {
using uint = std::uint32_t;
}
#define TESSERA_SHARED_BEGIN namespace tessera {
#define TESSERA_SHARED_END }
#else
#define TESSERA_SHARED_BEGIN
#define TESSERA_SHARED_END
#endif

#endif
