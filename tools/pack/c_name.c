/* c_name.c: checks and makes names of arrays in C code for any C or C++ program. */
#include "c_name.h"

#include <stdio.h>
#include <string.h>

/* Keywords with a blank on either side: C89 to C23, C++98 to C++26, GNU and Microsoft. */
static const char keywords[] =
    " alignas alignof and and_eq asm atomic_cancel atomic_commit atomic_noexcept auto bitand bitor bool break case "
    "catch "
    "char char8_t char16_t char32_t class compl concept const const_cast consteval constexpr constinit continue "
    "co_await "
    "co_return co_yield contract_assert decltype default delete do double dynamic_cast else enum explicit export "
    "extern "
    "false far float for friend goto if inline int interface long mutable namespace near new "
    "noexcept not not_eq nullptr operator or or_eq private protected public reflexpr register reinterpret_cast "
    "requires restrict return short signed sizeof static static_assert static_cast std struct switch synchronized "
    "template this thread_local throw true try typedef typeid typename typeof typeof_unqual union unsigned using "
    "virtual "
    "void volatile wchar_t while xor xor_eq ";

/* Macros of compilers in non-strict modes, and names of stddef.h and stdint.h that the patterns below do not match. */
static const char macros[] =
    " hpux i386 i486 i586 i686 linux m68k mips mips64 powerpc ppc riscv sgi sparc sun unix vax "
    "FALSE NULL PTRDIFF_MAX PTRDIFF_MIN SIG_ATOMIC_MAX SIG_ATOMIC_MIN SIZE_MAX TRUE WCHAR_MAX WCHAR_MIN WINT_MAX "
    "WINT_MIN "
    "EOF BUFSIZ RAND_MAX CHAR_BIT PPC R3000 R4000 WIN32 WIN64 WINNT errno assert offsetof unreachable "
    "small I complex imaginary CHAR_MAX CHAR_MIN CLOCKS_PER_SEC DECIMAL_DIG EXIT_FAILURE EXIT_SUCCESS FILE "
    "FILENAME_MAX FOPEN_MAX HUGE_VAL HUGE_VALF HUGE_VALL INFINITY LLONG_MAX LLONG_MIN LONG_MAX LONG_MIN L_tmpnam "
    "MB_CUR_MAX MB_LEN_MAX NAN SCHAR_MAX SCHAR_MIN SHRT_MAX SHRT_MIN TMP_MAX UCHAR_MAX ULLONG_MAX ULONG_MAX USHRT_MAX "
    "WEOF fpclassify isfinite isgreater isgreaterequal isinf isless islessequal islessgreater isnan isnormal "
    "isunordered jmp_buf math_errhandling signbit ";

/* Linked names of the C library. The names of math.h also exist with the suffixes f and l. */
static const char mathematics[] =
    " acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh erf erfc exp exp2 expm1 fabs fdim floor fma "
    "fmax "
    "fmin fmod frexp hypot ilogb ldexp lgamma llrint llround log log10 log1p log2 logb lrint lround modf nan nearbyint "
    "nextafter nexttoward pow remainder remquo rint round scalbln scalbn sin sinh sqrt tan tanh tgamma trunc "
    "cabs cacos cacosh carg casin casinh catan catanh ccos ccosh cexp cimag clog conj cpow cproj creal csin csinh "
    "csqrt "
    "ctan ctanh drem exp10 gamma j0 j1 jn pow10 scalb significand sincos y0 y1 yn ";

static const char functions[] =
    " main abort abs aligned_alloc asctime at_quick_exit atexit atof atoi atol atoll bsearch btowc c16rtomb c32rtomb "
    "call_once calloc clearerr clock ctime difftime div exit fclose feclearexcept fegetenv fegetexceptflag fegetround "
    "feholdexcept feof feraiseexcept ferror fesetenv fesetexceptflag fesetround fetestexcept feupdateenv fflush fgetc "
    "fgetpos fgets fgetwc fgetws fopen fprintf fputc fputs fputwc fputws fread free freopen fscanf fseek fsetpos ftell "
    "fwide fwprintf fwrite fwscanf getc getchar getenv gets getwc getwchar gmtime imaxabs imaxdiv isalnum isalpha "
    "isblank "
    "iscntrl isdigit isgraph islower isprint ispunct isspace isupper iswalnum iswalpha iswblank iswcntrl iswctype "
    "iswdigit iswgraph iswlower iswprint iswpunct iswspace iswupper iswxdigit isxdigit labs ldiv llabs lldiv "
    "localeconv "
    "localtime longjmp malloc mblen mbrlen mbrtoc16 mbrtoc32 mbrtowc mbsinit mbsrtowcs mbstowcs mbtowc memccpy memchr "
    "memcmp memcpy memmove mempcpy memrchr memset mktime perror printf putc putchar puts putwc putwchar qsort "
    "quick_exit "
    "raise rand realloc remove rename rewind scanf setbuf setjmp setlocale setvbuf signal snprintf sprintf srand "
    "sscanf "
    "stderr stdin stdout strcat strchr strcmp strcoll strcpy strcspn strdup strerror strftime strlen strncat strncmp "
    "strncpy strndup strnlen strpbrk strrchr strspn strstr strtod strtof strtoimax strtok strtol strtold strtoll "
    "strtoul "
    "strtoull strtoumax strxfrm swprintf swscanf system time timespec_get tmpfile tmpnam tolower toupper towctrans "
    "towlower towupper ungetc ungetwc va_arg va_copy va_end va_list va_start vfprintf vfscanf vfwprintf vfwscanf "
    "vprintf "
    "vscanf vsnprintf vsprintf vsscanf vswprintf vswscanf vwprintf vwscanf wcrtomb wcscat wcschr wcscmp wcscoll wcscpy "
    "wcscspn wcsftime wcslen wcsncat wcsncmp wcsncpy wcspbrk wcsrchr wcsrtombs wcsspn wcsstr wcstod wcstof wcstoimax "
    "wcstok wcstol wcstold wcstoll wcstombs wcstoul wcstoull wcstoumax wcsxfrm wctob wctomb wctrans wctype wmemchr "
    "wmemcmp wmemcpy wmemmove wmemset wprintf wscanf ";

/* Short names of POSIX. A C library calls some of these itself. */
static const char posix[] =
    " accept access alarm alloca alphasort bcmp bcopy bind brk bzero chdir chmod chown close connect creat daylight "
    "dirname "
    "basename dup dup2 environ execl execle execlp execv execve execvp fchmod fchown fcntl fdopen ffs fileno fork "
    "fstat fsync "
    "ftruncate getcwd getgid getline getopt getpid getppid getuid glob htonl htons hsearch index inet_addr ioctl "
    "isatty "
    "kill lfind link listen lsearch lseek lstat mkdir mkfifo mknod mkstemp mmap mount mprotect msync munmap nanosleep "
    "ntohl ntohs open opendir optarg opterr optind optopt pause pclose pipe poll popen pread putenv pwrite random read "
    "readdir readlink realpath recv regcomp regexec rindex rmdir sbrk select send setenv shutdown sigaction sleep "
    "socket "
    "srandom stat stpcpy strcasecmp strsep sync syscall sysconf tdelete tfind timezone truncate tsearch ttyname twalk "
    "tzname tzset umask uname unlink unsetenv usleep utime vfork wait waitpid write ";

static int is_digit(char c) { return c >= '0' && c <= '9'; }
static int is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

static int is_in(const char *list, const char *word, size_t n)
{
    for (const char *at = list; (at = strstr(at, " ")) != NULL; ++at) {
        if (strncmp(at + 1, word, n) == 0 && at[1 + n] == ' ') {
            return 1;
        }
    }
    return 0;
}

static int begins(const char *name, const char *with) { return strncmp(name, with, strlen(with)) == 0; }

static int ends(const char *name, const char *with)
{
    const size_t n = strlen(name), m = strlen(with);
    return n >= m && strcmp(name + n - m, with) == 0;
}

/* size_t, time_t and all other names that end with _t, which POSIX reserves; INT8_C, UINTMAX_MAX and so on, including
 * names reserved for the future (C99, 7.26.8). */
static int is_type(const char *name)
{
    return ends(name, "_t") ||
           ((begins(name, "INT") || begins(name, "UINT")) &&
            (ends(name, "_MAX") || ends(name, "_MIN") || ends(name, "_C") || ends(name, "_WIDTH")));
}

/* Macros of errno.h, fenv.h, float.h, inttypes.h, locale.h, math.h, signal.h and stdio.h, including names reserved for
 * the future. */
static int is_macro(const char *name, size_t n)
{
    static const char *const heads[] = {"E", "FE_", "DBL_", "FLT_", "LDBL_", "LC_",
                                        "SIG", "SIG_", "FP_", "M_", "MATH_", "SEEK_"};
    for (size_t i = 0; i < sizeof heads / sizeof *heads; ++i) {
        const char *rest = begins(name, heads[i]) ? name + strlen(heads[i]) : "";
        if (is_digit(rest[0]) || (rest[0] >= 'A' && rest[0] <= 'Z')) {
            return 1;
        }
    }
    const int is_format = (begins(name, "PRI") || begins(name, "SCN")) && n > 3 && strchr("diouxX", name[3]) != NULL;
    return is_format || is_in(macros, name, n);
}

static int is_mathematics(const char *name, size_t n)
{
    return is_in(mathematics, name, n) ||
           (n > 1 && (name[n - 1] == 'f' || name[n - 1] == 'l') && is_in(mathematics, name, n - 1));
}

static const char *shape_of(const char *name)
{
    if (name[0] == '\0') {
        return "it is empty";
    }
    for (const char *c = name; *c != '\0'; ++c) {
        if (!is_letter(*c) && !is_digit(*c) && *c != '_') {
            return "names in C have letters, digits and _";
        }
    }
    return is_digit(name[0])               ? "it begins with a digit"
           : name[0] == '_'                ? "names that begin with _ are the compiler's"
           : strstr(name, "__") != NULL    ? "names with two _ in a row are C++'s own"
           : strlen(name) > C_NAME - 1     ? "it is longer than 63 characters"
           : name[strlen(name) - 1] == '_' ? "behind it comes _bytes, and two _ in a row are C++'s own"
                                           : NULL;
}

const char *c_name_check(const char *name)
{
    const size_t n = strlen(name);
    const char *shape = shape_of(name);
    if (shape != NULL) {
        return shape;
    }
    return is_in(keywords, name, n)                               ? "it is a keyword of C or C++"
           : is_macro(name, n) || is_type(name)           ? "compilers or headers have it as their own"
           : is_in(functions, name, n) || is_mathematics(name, n) ? "the C library has it"
           : is_in(posix, name, n)                                ? "system libraries have it"
           : begins(name, "lmb_") || begins(name, "LMB_")         ? "names that begin with lmb_ are the library's"
                                                                  : NULL;
}

/* Copies the file name up to its first dot. Each run of other characters than letters and digits becomes one _. Returns
 * the length. */
static size_t put_letters(char *out, size_t size, const char *name)
{
    size_t n = 0;
    for (; *name != '\0' && *name != '.' && n + 1 < size; ++name) {
        if (is_letter(*name) || is_digit(*name)) {
            out[n++] = *name;
        } else if (n == 0 || out[n - 1] != '_') {
            out[n++] = '_';
        }
    }
    while (n > 0 && out[n - 1] == '_') {
        --n;
    }
    out[n] = '\0';
    return n;
}

static const char *name_in(const char *path)
{
    const char *name = path;
    for (const char *c = path; *c != '\0'; ++c) {
#ifdef _WIN32
        name = *c == '\\' || *c == ':' ? c + 1 : name;
#endif
        name = *c == '/' ? c + 1 : name;
    }
    return name;
}

void c_name_of(char out[C_NAME], const char *path)
{
    char letters[C_NAME];
    const char *name = name_in(path);
    put_letters(letters, sizeof letters, name);
    if (c_name_check(letters) == NULL) {
        strcpy(out, letters);
        return;
    }
    snprintf(out, C_NAME, "scene%s%.50s", letters[0] == '_' || letters[0] == '\0' ? "" : "_", letters);
    while (out[strlen(out) - 1] == '_') {
        out[strlen(out) - 1] = '\0';
    }
}
