// SPDX-License-Identifier: GPL-3.0-or-later
// Lets modules that GCC 12 compiles with glibc 2.36 run on Linux as old as RHEL 8 (glibc 2.28, C++
// library of GCC 8). The compiler asks for eight names that are newer. The module has its own
// instead, each made of an older one; no name here is seen outside of it. check_module.py refuses
// modules that need newer names.
#include <pthread.h>

#include <new>
#include <sstream>

#ifdef __aarch64__
#define OLDEST "GLIBC_2.17"
#else
#define OLDEST "GLIBC_2.2.5"
#endif
__asm__(".symver log_of_old, log@" OLDEST);
__asm__(".symver pthread_once_of_old, pthread_once@" OLDEST);
__asm__(".symver copy_exception, _ZNSt15__exception_ptr13exception_ptrC1ERKS0_@CXXABI_1.3.3");
__asm__(".symver destroy_exception, _ZNSt15__exception_ptr13exception_ptrD1Ev@CXXABI_1.3.3");

// NOLINTBEGIN: the names are those that the compiler asks for.
extern "C" {
double log_of_old(double x);
int pthread_once_of_old(pthread_once_t* flag, void (*call)());

double log(double x) { return log_of_old(x); }
int pthread_once(pthread_once_t* flag, void (*call)()) { return pthread_once_of_old(flag, call); }

// An older C library cannot tell whether a process has one thread.
char __libc_single_threaded = 0;

// The reference of an exception is counted by a copy that is never destroyed. Both are the
// library's by version: units in which the compiler puts no copy inline have their own, which call
// these here.
void copy_exception(void* to, const void* from);
void destroy_exception(void* one);
void add_reference(void* one) __asm__("_ZNSt15__exception_ptr13exception_ptr9_M_addrefEv");
void release_reference(void* one) __asm__("_ZNSt15__exception_ptr13exception_ptr10_M_releaseEv");
void throw_bad_length() __asm__("_ZSt28__throw_bad_array_new_lengthv");

void add_reference(void* one) {
  void* copy = nullptr;
  copy_exception(&copy, one);
}
void release_reference(void* one) { destroy_exception(one); }
void throw_bad_length() { throw std::bad_array_new_length(); }
}

template std::basic_ostringstream<char>::basic_ostringstream();
template std::string std::basic_stringbuf<char>::str() const&;
// NOLINTEND
