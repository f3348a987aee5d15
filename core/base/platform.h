#pragma once

/// The project's only macros. They control inlining beyond the means of the language.

/// Forces inlining, so that a template shared with a kernel leaves no weak symbol behind.
#define BOULE_INLINE [[gnu::always_inline]] inline

/// Keeps a cold path out of a hot loop's registers.
#define BOULE_NOINLINE [[gnu::noinline]]
