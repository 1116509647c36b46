// node check.mjs CHROMIUM AXE_JS FOLDER REPORT...: looks at reports as a browser shows them. Exit code 1 when something is
// wrong. FOLDER takes what the browser prints, NAME.pdf.
import { readFileSync, writeFileSync } from 'node:fs';
import { basename, dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { Browser } from './browser.mjs';

const [program, axe, folder, ...reports] = process.argv.slice(2);
const widths = [360, 768, 1280, 1920];
const schemes = ['light', 'dark'];
let wrong = 0;

function tell(where, what) {
  ++wrong;
  console.log(`${where}: ${what}`);
}

const browser = new Browser(program);
try {
  for (const report of reports) {
    const name = basename(dirname(report));
    await browser.open(pathToFileURL(report).href);
    await browser.value(readFileSync(axe, 'utf8') + ';0');
    // Folded tables are looked at as well.
    await browser.value('for (const part of document.querySelectorAll("details")) part.open = true');
    for (const width of widths) {
      for (const scheme of schemes) {
        await browser.show(width, scheme);
        const where = `${name} at ${width} px, ${scheme}`;
        // What the scheme changes are colours.
        const rules = scheme === 'dark' ? ', runOnly: ["cat.color"]' : '';
        const found = await browser.value(
          `axe.run(document, { resultTypes: ["violations"]${rules} })` +
          '.then(({ violations }) => violations.map(({ id, help, nodes }) =>' +
          ' ({ id, help, count: nodes.length, nodes: nodes.slice(0, 3).map(({ html, failureSummary }) =>' +
          ' [html.slice(0, 160), failureSummary]) })))');
        for (const { id, help, count, nodes } of found) {
          tell(where, `${id}: ${help} (${count} places)`);
          for (const [html, summary] of nodes) console.log(`    ${html}\n      ${summary.replaceAll('\n', '\n      ')}`);
        }
        const wide = await browser.value('document.documentElement.scrollWidth - document.documentElement.clientWidth');
        if (wide > 0) tell(where, `the page is ${wide} px wider than the window`);
      }
    }
    await browser.value('for (const part of document.querySelectorAll("details")) part.open = false');
    const { data } = await browser.send('Page.printToPDF', { printBackground: false, preferCSSPageSize: true });
    writeFileSync(join(folder, `${name}.pdf`), Buffer.from(data, 'base64'));
  }
} finally {
  await browser.close();
}
process.exit(wrong > 0 ? 1 : 0);
