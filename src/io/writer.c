#include "io/writer.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include "base/memory.h"
#include "base/text.h"
#include "io/part_file.h"

enum { BUFFER_SIZE = 1 << 18 };

struct hs_writer {
    char *path;        /**< as given; owned */
    hs_part_file part; /**< a whole file until it is complete; none in place */
    int fd;
    bool is_regular;   /**< can be cut back */
    int64_t committed; /**< bytes of the file up to the last commit */
    size_t n;          /**< bytes waiting in the buffer */
    char *buffer;      /**< owned [BUFFER_SIZE] */
    bool is_gzip, in_member;
    z_stream stream; /**< live while in_member */
    char *packed;    /**< owned [BUFFER_SIZE], compressed bytes; NULL unless is_gzip */
};

static hs_status fail_io(const hs_writer *writer, const char *what, hs_error *err)
{
    return hs_fail(err, HS_ERROR_IO, "'%s' could not be %s: %s", writer->path, what, strerror(errno));
}

static hs_status write_all(hs_writer *writer, const char *bytes, size_t n, hs_error *err)
{
    while (n > 0) {
        ssize_t written = write(writer->fd, bytes, n);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return fail_io(writer, "written", err);
        bytes += written;
        n -= (size_t)written;
    }
    return HS_OK;
}

/** Send the buffer through the compressor; @p flush is Z_NO_FLUSH or Z_FINISH. */
static hs_status deflate_buffer(hs_writer *writer, int flush, hs_error *err)
{
    enum { GZIP_WINDOW = 15 + 16 };
    if (!writer->in_member) {
        memset(&writer->stream, 0, sizeof writer->stream);
        if (deflateInit2(&writer->stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, GZIP_WINDOW, 8, Z_DEFAULT_STRATEGY) !=
            Z_OK)
            return hs_fail(err, HS_ERROR_MEMORY, "'%s': the compressor could not be started", writer->path);
        writer->in_member = true;
    }
    writer->stream.next_in = (Bytef *)writer->buffer;
    writer->stream.avail_in = (uInt)writer->n;
    int result;
    do {
        writer->stream.next_out = (Bytef *)writer->packed;
        writer->stream.avail_out = BUFFER_SIZE;
        result = deflate(&writer->stream, flush);
        HS_TRY(write_all(writer, writer->packed, BUFFER_SIZE - writer->stream.avail_out, err));
    } while (writer->stream.avail_out == 0 || (flush == Z_FINISH && result == Z_OK));
    writer->n = 0;
    if (flush == Z_FINISH) {
        deflateEnd(&writer->stream);
        writer->in_member = false;
    }
    return HS_OK;
}

static hs_status drain(hs_writer *writer, hs_error *err)
{
    if (writer->is_gzip) return deflate_buffer(writer, Z_NO_FLUSH, err);
    const size_t n = writer->n;
    writer->n = 0;
    return write_all(writer, writer->buffer, n, err);
}

/** Forget what was written since the last commit. */
static void roll_back(hs_writer *writer)
{
    writer->n = 0;
    if (writer->in_member) deflateEnd(&writer->stream);
    writer->in_member = false;
    if (writer->is_regular && ftruncate(writer->fd, writer->committed) == 0)
        lseek(writer->fd, writer->committed, SEEK_SET);
}

static void destroy(hs_writer **writer)
{
    hs_writer *self = *writer;
    if (self->in_member) deflateEnd(&self->stream);
    if (self->fd >= 0) close(self->fd);
    HS_FREE(self->path);
    HS_FREE(self->buffer);
    HS_FREE(self->packed);
    HS_FREE(*writer);
}

static hs_status open_file(hs_writer *writer, hs_write_mode mode, hs_error *err)
{
    struct stat info;
    const bool exists = stat(writer->path, &info) == 0;
    writer->is_regular = !exists || S_ISREG(info.st_mode);
    if (!writer->is_regular) {
        writer->fd = open(writer->path, O_WRONLY);
    } else if (mode == HS_WRITE_WHOLE) {
        HS_TRY(hs_part_file_make(&writer->part, writer->path, err));
        writer->fd = open(writer->part.path, O_WRONLY);
    } else {
        writer->fd = open(writer->path, O_WRONLY | O_CREAT | (mode == HS_WRITE_REPLACE ? O_TRUNC : 0), 0666);
        if (writer->fd >= 0 && mode == HS_WRITE_APPEND) writer->committed = lseek(writer->fd, 0, SEEK_END);
    }
    if (writer->fd < 0)
        return hs_fail(err, HS_ERROR_IO, "'%s' could not be opened for writing: %s", writer->path, strerror(errno));
    return HS_OK;
}

hs_status hs_writer_open(hs_writer **writer, const char *path, hs_write_mode mode, hs_error *err)
{
    HS_TRY(HS_ALLOC(*writer, 1, err));
    hs_writer *self = *writer;
    const size_t n = strlen(path);
    self->fd = -1;
    self->is_gzip = n > 3 && strcmp(path + n - 3, ".gz") == 0;
    hs_status status = hs_memory_strdup(&self->path, path, err);
    if (status == HS_OK) status = HS_ALLOC(self->buffer, BUFFER_SIZE, err);
    if (status == HS_OK && self->is_gzip) status = HS_ALLOC(self->packed, BUFFER_SIZE, err);
    if (status == HS_OK) status = open_file(self, mode, err);
    if (status != HS_OK) destroy(writer);
    return status;
}

int64_t hs_writer_committed(const hs_writer *writer) { return writer->committed; }

hs_status hs_writer_cut(hs_writer *writer, int64_t size, hs_error *err)
{
    if (!writer->is_regular || size >= writer->committed) return HS_OK;
    if (ftruncate(writer->fd, size) != 0 || lseek(writer->fd, size, SEEK_SET) < 0) return fail_io(writer, "cut", err);
    writer->committed = size;
    return HS_OK;
}

hs_status hs_writer_bytes(hs_writer *writer, const char *bytes, size_t n, hs_error *err)
{
    while (n > 0) {
        const size_t n_fit = n < BUFFER_SIZE - writer->n ? n : BUFFER_SIZE - writer->n;
        memcpy(writer->buffer + writer->n, bytes, n_fit);
        writer->n += n_fit;
        bytes += n_fit;
        n -= n_fit;
        if (writer->n == BUFFER_SIZE) HS_TRY(drain(writer, err));
    }
    return HS_OK;
}

hs_status hs_writer_printf(hs_writer *writer, hs_error *err, const char *fmt, ...)
{
    enum { LONGEST = 4096 };
    va_list args, again;
    if (BUFFER_SIZE - writer->n < LONGEST) HS_TRY(drain(writer, err));
    va_start(args, fmt);
    va_copy(again, args);
    const int n = vsnprintf(writer->buffer + writer->n, BUFFER_SIZE - writer->n, fmt, args);
    va_end(args);
    hs_status status = HS_OK;
    if (n >= 0 && (size_t)n < BUFFER_SIZE - writer->n) {
        writer->n += (size_t)n;
    } else if (n >= 0) { /* longer than the rest of the buffer */
        char *text;
        status = HS_ALLOC(text, (size_t)n + 1, err);
        if (status == HS_OK) {
            vsnprintf(text, (size_t)n + 1, fmt, again);
            status = hs_writer_bytes(writer, text, (size_t)n, err);
        }
        HS_FREE(text);
    } else {
        status = hs_fail(err, HS_ERROR_RUN, "text could not be formatted with '%s'", fmt);
    }
    va_end(again);
    return status;
}

hs_status hs_writer_commit(hs_writer *writer, hs_error *err)
{
    hs_status status;
    if (writer->is_gzip)
        status = writer->n > 0 || writer->in_member ? deflate_buffer(writer, Z_FINISH, err) : HS_OK;
    else
        status = drain(writer, err);
    if (status != HS_OK)
        roll_back(writer);
    else if (writer->is_regular)
        writer->committed = lseek(writer->fd, 0, SEEK_CUR);
    return status;
}

hs_status hs_writer_patch(hs_writer *writer, int64_t place, const char *bytes, size_t n, hs_error *err)
{
    if (!writer->is_regular) return HS_OK;
    while (n > 0) {
        const ssize_t written = pwrite(writer->fd, bytes, n, place);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return fail_io(writer, "written", err);
        bytes += written;
        place += written;
        n -= (size_t)written;
    }
    return HS_OK;
}

hs_status hs_writer_close(hs_writer **writer, hs_error *err)
{
    if (*writer == NULL) return HS_OK;
    hs_writer *self = *writer;
    hs_status status = hs_writer_commit(self, err);
    if (status == HS_OK && self->is_regular && fsync(self->fd) != 0) status = fail_io(self, "flushed to disk", err);
    if (close(self->fd) != 0 && status == HS_OK) status = fail_io(self, "closed", err);
    self->fd = -1;
    if (status == HS_OK && self->part.path != NULL) status = hs_part_file_finish(&self->part, err);
    hs_part_file_abandon(&self->part);
    destroy(writer);
    return status;
}

void hs_writer_abandon(hs_writer **writer)
{
    if (*writer == NULL) return;
    roll_back(*writer);
    hs_part_file_abandon(&(*writer)->part);
    destroy(writer);
}

hs_status hs_writer_step_name(char **name, const char *pattern, int64_t step, int pad, hs_error *err)
{
    const char *star = strchr(pattern, '*');
    hs_text text = {0};
    if (star == NULL) return hs_memory_strdup(name, pattern, err);
    hs_status status = hs_text_append(&text, pattern, (size_t)(star - pattern), err);
    if (status == HS_OK) status = hs_text_printf(&text, err, "%0*lld%s", pad, (long long)step, star + 1);
    if (status == HS_OK) status = hs_memory_strdup(name, hs_text_get(&text), err);
    hs_text_fini(&text);
    return status;
}
