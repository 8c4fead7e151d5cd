// OpenAL Soft is not built with the thread sanitizer, which therefore misses its atomics and
// reports the ring between its mixer and its event thread. Its own memory traffic is left out;
// races between our threads are still found.
#if defined(__SANITIZE_THREAD__)
extern "C" [[gnu::visibility("default")]] const char* __tsan_default_suppressions();
const char* __tsan_default_suppressions() { return "called_from_lib:libopenal.so\n"; }
#endif
