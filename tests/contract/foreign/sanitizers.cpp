// Reports of sanitizers that are about libx265 as Debian ships it, which encodes for a test.

#if !defined(__has_feature)
#define __has_feature(feature) 0
#endif

#if __has_feature(address_sanitizer)
// Some kilobytes are forgotten by each encoder.
extern "C" __attribute__((visibility("default"))) const char *__lsan_default_suppressions() {
  return "leak:libx265.so\n";
}
#endif
