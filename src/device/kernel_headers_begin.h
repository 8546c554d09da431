// Stands before kernel headers (.clh) that the host compiles as C++ inside namespace tessera::kernels, after device/lanes_host.h;
// device/kernel_headers_end.h stands behind them. No guard: each use needs it anew.
// The headers are C: casts and index types are theirs, and address spaces mean nothing here.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wparentheses"
#define global
#define local
#define constant static const
