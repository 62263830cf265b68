/* @{value_comment}: @{file}, 8-byte numbers, lowest byte first */
static double ft_value[@{n_values}];
static const ft_values ft_table = {ft_value, 0};
#ifdef _WIN32
static INIT_ONCE ft_begun = INIT_ONCE_STATIC_INIT;
#else
static pthread_once_t ft_begun = PTHREAD_ONCE_INIT;
#endif
static int ft_good = 0;
static char ft_directory[4000] = "";

int frictab_directory(const char* directory) {
  if (strlen(directory) >= sizeof ft_directory) return 0;
  strcpy(ft_directory, directory);
  return 1;
}

/* CRC-32 as in zip and zlib. */
static unsigned long ft_crc32(const unsigned char* bytes, size_t n) {
  unsigned long table[256], crc = 0xFFFFFFFFul;
  unsigned long i;
  int bit;
  size_t k;
  for (i = 0; i < 256; ++i) {
    unsigned long c = i;
    for (bit = 0; bit < 8; ++bit)
      c = c & 1ul ? (c >> 1) ^ 0xEDB88320ul : c >> 1;
    table[i] = c;
  }
  for (k = 0; k < n; ++k)
    crc = (crc >> 8) ^ table[(crc ^ bytes[k]) & 0xFFul];
  return crc ^ 0xFFFFFFFFul;
}

static void ft_read(void) {
  static char path[4200];
  const double one = 1.0;
  const char* directory = ft_directory[0] ? ft_directory : getenv("FRICTAB_DIR");
  const char* fault = "damaged, or made for another source (CRC-32)";
  FILE* in;
  if (!directory || !directory[0]) directory = ".";
  snprintf(path, sizeof path, "%.4000s/@{file}", directory);
  in = fopen(path, "rb");
  if (!in)
    fault = "cannot be opened";
  else if (((const unsigned char*)&one)[7] != 0x3F)
    fault = "has its lowest bytes first, this machine not";
  else if (fread(ft_value, sizeof(double), @{n_values}u, in) != @{n_values}u || fgetc(in) != EOF)
    fault = "has not the @{n_bytes} bytes that are expected";
  else
    ft_good = ft_crc32((const unsigned char*)ft_value, sizeof ft_value) == @{crc32}ul;
  if (in) fclose(in);
  if (!ft_good) fprintf(stderr, "friction table: %s: %s\n", path, fault);
}

/* True once the values are there: the first call reads them while other threads wait. */
#ifdef _WIN32
static BOOL CALLBACK ft_task(PINIT_ONCE begun, PVOID given, PVOID* got) {
  (void)begun, (void)given, (void)got;
  ft_read();
  return TRUE;
}
static int ft_ready(void) {
  return InitOnceExecuteOnce(&ft_begun, ft_task, NULL, NULL) && ft_good;
}
#else
static int ft_ready(void) {
  return pthread_once(&ft_begun, ft_read) == 0 && ft_good;
}
#endif
