/* What the binding needs beside the C interface: memory outside the heap, and calls back into Java. */
#include <jni.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include <spherecloud/spherecloud.h>

#define POINTER(address) ((void *)(intptr_t)(address))
#define ADDRESS(pointer) ((jlong)(intptr_t)(pointer))
#define NATIVE(type, name) JNIEXPORT type JNICALL Java_org_spherecloud_##name

static JavaVM *java;
static jclass callbacks;
static jmethodID log_line, clock_time;

JNIEXPORT jint JNICALL JNI_OnLoad(JavaVM *vm, void *reserved) {
  (void)reserved;
  JNIEnv *env;
  java = vm;
  if ((*vm)->GetEnv(vm, (void **)&env, JNI_VERSION_1_6) != JNI_OK) return JNI_ERR;
  jclass found = (*env)->FindClass(env, "org/spherecloud/Callback");
  if (!found) return JNI_ERR;
  callbacks = (*env)->NewGlobalRef(env, found);
  log_line = (*env)->GetStaticMethodID(env, found, "log", "(Lorg/spherecloud/Log;ILjava/lang/String;)V");
  clock_time = (*env)->GetStaticMethodID(env, found, "time", "(Lorg/spherecloud/Clock;)J");
  return callbacks && log_line && clock_time ? JNI_VERSION_1_6 : JNI_ERR;
}

/* ---- what the library is ---- */

NATIVE(jint, Library_abi)(JNIEnv *env, jclass type) {
  (void)env, (void)type;
  return (jint)sphc_abi();
}

NATIVE(jstring, Library_version)(JNIEnv *env, jclass type) {
  (void)type;
  return (*env)->NewStringUTF(env, sphc_version_string());
}

/* ---- memory ---- */

NATIVE(jint, Memory_pointerBytes)(JNIEnv *env, jclass type) {
  (void)env, (void)type;
  return (jint)sizeof(void *);
}

NATIVE(jlong, Memory_allocate)(JNIEnv *env, jclass type, jlong bytes, jlong alignment) {
  (void)env, (void)type;
  void *made = NULL;
  const size_t least = sizeof(void *), wanted = (size_t)alignment;
  if (bytes < 0 || (uint64_t)bytes >= SIZE_MAX) return 0; /* one byte is added, so that none is no size of 0 */
  if (posix_memalign(&made, wanted < least ? least : wanted, (size_t)bytes + 1)) return 0;
  return ADDRESS(memset(made, 0, (size_t)bytes));
}

NATIVE(void, Memory_free)(JNIEnv *env, jclass type, jlong address) {
  (void)env, (void)type;
  free(POINTER(address));
}

NATIVE(jlong, Memory_address)(JNIEnv *env, jclass type, jobject buffer) {
  (void)type;
  return ADDRESS((*env)->GetDirectBufferAddress(env, buffer));
}

NATIVE(jobject, Memory_view)(JNIEnv *env, jclass type, jlong address, jlong bytes) {
  (void)type;
  return (*env)->NewDirectByteBuffer(env, POINTER(address), bytes);
}

NATIVE(void, Memory_copy)(JNIEnv *env, jclass type, jlong to, jlong from, jlong bytes) {
  (void)env, (void)type;
  memmove(POINTER(to), POINTER(from), (size_t)bytes);
}

/* ---- calls back ---- */

/* Null where nothing of Java may be called: after an exception, which comes out when the native call returns. */
static JNIEnv *able_to_call(void) {
  JNIEnv *env;
  if ((*java)->GetEnv(java, (void **)&env, JNI_VERSION_1_6) != JNI_OK) return NULL;
  return (*env)->ExceptionCheck(env) ? NULL : env;
}

static void log_to_java(void *user, sphc_log_level level, const char *text, size_t length) {
  (void)length;
  JNIEnv *env = able_to_call();
  jstring line = env ? (*env)->NewStringUTF(env, text) : NULL;
  if (!line) return;
  (*env)->CallStaticVoidMethod(env, callbacks, log_line, (jobject)user, (jint)level, line);
  (*env)->DeleteLocalRef(env, line);
}

static int64_t time_of_java(void *user) {
  JNIEnv *env = able_to_call();
  return env ? (*env)->CallStaticLongMethod(env, callbacks, clock_time, (jobject)user) : 0;
}

static int64_t monotonic_time(void *user) {
  (void)user;
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

NATIVE(jlong, Callback_reference)(JNIEnv *env, jclass type, jobject called) {
  (void)type;
  return ADDRESS((*env)->NewGlobalRef(env, called));
}

NATIVE(void, Callback_dropReference)(JNIEnv *env, jclass type, jlong user) {
  (void)type;
  (*env)->DeleteGlobalRef(env, (jobject)POINTER(user));
}

NATIVE(jlong, Callback_logFunction)(JNIEnv *env, jclass type) {
  (void)env, (void)type;
  return ADDRESS(log_to_java);
}

NATIVE(jlong, Callback_clockFunction)(JNIEnv *env, jclass type) {
  (void)env, (void)type;
  return ADDRESS(time_of_java);
}

NATIVE(jlong, Callback_monotonicClockFunction)(JNIEnv *env, jclass type) {
  (void)env, (void)type;
  return ADDRESS(monotonic_time);
}
