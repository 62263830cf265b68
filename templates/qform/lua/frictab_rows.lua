-- Rows of states from a file through frictab_tau_R: a row of numbers per line in, a number per line
-- out.
local source, rows, answers = arg[1], arg[2], arg[3]
local known = {inf = math.huge, ["-inf"] = -math.huge, nan = math.huge - math.huge,
  ["-nan"] = math.huge - math.huge}
function parameter(_, default)
  return default
end
dofile(source)
local unpack = table.unpack or unpack
local out = assert(io.open(answers, "w"))
for line in assert(io.open(rows)):lines() do
  local x, n = {}, 0
  for word in line:gmatch("%S+") do
    n = n + 1
    x[n] = known[word] or tonumber(word)
  end
  out:write(string.format("%.17g\n", frictab_tau_R(unpack(x, 1, n))))
end
out:close()
