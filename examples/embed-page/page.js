// Takes the G-code of what the visitor has made, and puts it into the order instead of the visitor's downloads.
const studio = document.querySelector('sillon-studio');
const order = document.querySelector('#order');
const told = document.querySelector('#told');

studio.addEventListener('result', ({ detail }) => {
  order.disabled = false;
  told.textContent = `${(detail.report.lengthMm / 1000).toFixed(1)} m of beads`;
});
studio.addEventListener('error', ({ detail }) => {
  told.textContent = `${detail.message} ${detail.hint}`;
});
order.addEventListener('click', async () => {
  order.disabled = true;
  const { name, blob } = await studio.exportGcode();
  told.textContent = `${name}: ${blob.size} bytes for the printer`; // here a shop would upload it
  order.disabled = false;
});
