// The way of somebody with a printer and no idea, from the first page to a file.

/**
 * @param visit  of the studio
 * @param first  coupon or coaster
 * @param seen  is called wherever there is something new to read, with what is to be read
 * @returns what a hand does, and the download
 */
export async function walkToFirstPrint(visit, first, seen = () => {}) {
  const { page } = visit;
  let clicks = 0;
  const click = async (locator) => {
    ++clicks;
    await locator.click();
  };
  await seen(page.locator('body'));
  await click(visit.button('Menu'));
  await click(page.locator('#menu').getByRole('button', { name: 'First print…' }));
  const dialog = page.locator('sillon-first dialog');
  await dialog.waitFor();
  clicks += 2; // opens the list, and chooses
  await dialog.getByLabel('Printer', { exact: true }).selectOption({ label: 'Creality K1' });
  await click(dialog.locator(`input[value=${first}]`));
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    click(dialog.getByRole('button', { name: 'Download G-code' })),
  ]);
  await page.getByText('What to look at afterwards').waitFor();
  await seen(dialog);
  return { clicks, download };
}
