// Ends what device/kernel_headers_begin.h began.
#undef global
#undef local
#undef constant
#pragma GCC diagnostic pop
