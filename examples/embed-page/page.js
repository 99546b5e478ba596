// Takes the G-code of what the visitor has made, and puts it into the order instead of the visitor's downloads.
const studio = document.querySelector('sillon-studio');
const order = document.querySelector('#order');
const told = document.querySelector('#told');
const wrong = document.querySelector('#wrong');

studio.addEventListener('change', () => {
  wrong.textContent = '';
});
studio.addEventListener('result', ({ detail }) => {
  order.disabled = false;
  told.textContent = `${(detail.report.lengthMm / 1000).toFixed(1)} m of beads`;
});
studio.addEventListener('error', async ({ detail }) => {
  wrong.textContent = `${detail.message} ${detail.hint}`;
  order.disabled = (await studio.report().catch(() => null)) === null; // there is nothing to be ordered
  if (order.disabled) told.textContent = '';
});
order.addEventListener('click', async () => {
  order.disabled = true;
  try {
    const { name, blob } = await studio.exportGcode();
    told.textContent = `${name}: ${blob.size} bytes for the printer`; // here a shop would upload it
    order.disabled = false;
  } catch (error) {
    wrong.textContent = `${error.message} ${error.hint}`; // nothing is ordered
  }
});
