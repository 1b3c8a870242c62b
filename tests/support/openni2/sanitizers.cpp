// Reports of sanitizers that are about OpenNI2 as Debian ships it, not about this project's code.  Compiled in,
// because the first of them come before a test program can be given options.

#if !defined(__has_feature)
#define __has_feature(feature) 0
#endif

extern "C" {

#if __has_feature(address_sanitizer)
// Some kilobytes are forgotten each time it starts, a megabyte each time it records.
__attribute__((visibility("default"))) const char *__lsan_default_suppressions() {
  return "leak:libOpenNI2.so\nleak:libOniFile.so\n";
}
#endif

#if __has_feature(thread_sanitizer)
// Its locks are freed in a way that the sanitizer does not know, and taken in many orders; its flags are no
// atomics.
__attribute__((visibility("default"))) const char *__tsan_default_suppressions() {
  return "deadlock:libOpenNI2.so\ndeadlock:libOniFile.so\nmutex:libOpenNI2.so\nmutex:libOniFile.so\nrace:"
         "libOpenNI2.so\nrace:libOniFile.so\n";
}
#endif

}  // extern "C"
