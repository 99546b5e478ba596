/** CPU time of this process so far [ms], which others at work on the machine do not lengthen. */
export function cpuTime(): number {
  const { user, system } = process.cpuUsage();
  return (user + system) / 1000;
}
